// What stands below a table: how to read it, how its figures are defined, what is missing, where they come
// from.
#pragma once

#include "report/paper_tables.h"
#include "report/runs.h"
#include "report/table.h"

#include <span>
#include <string>
#include <vector>

namespace tamp {

/// What the notes are written from. `command` is what would run the missing jobs.
struct NotesInput {
  const Plan& plan;
  std::span<const RunGroup> groups;
  std::string command;
  std::string table;                     ///< its name
  std::string content;                   ///< what of a campaign belongs into it: "lognormal powder in 2D"
  const PaperTable* lognormal = nullptr; ///< what a lognormal table is compared with
};

/// Of lognormal tables: meaning of lines and columns, with the parameters of the campaign's metrics.
std::vector<Note> estimator_notes(const NotesInput& input);

/// How times were taken; what was run.
std::vector<Note> run_notes(const NotesInput& input);

/// Of lognormal tables: reasons known beforehand for which our figures and the paper's differ; only those that concern
/// the runs at hand.
std::vector<Note> protocol_notes(const NotesInput& input);

/// Jobs that did not end ok, with their reasons; jobs without a record, with the command that runs them.
std::vector<Note> outcome_notes(const NotesInput& input);

/// Campaign, keys, builds, machines and dates of all records of the groups; nothing but records is asked, so the same
/// store gives the same text at any time and on any machine.
std::vector<Note> provenance_notes(const NotesInput& input);

/// All of them, in this order, the first and the third for lognormal tables only; `own` is what a table says itself,
/// and stands first.
std::vector<Note> all_notes(const NotesInput& input, std::vector<Note> own = {});

/// The sentence on the paper's times, for tables that have them.
std::string paper_time_sentence();

/// The first twelve digits of a key or commit: enough to find it.
std::string short_key(const std::string& key);

/// The records behind the groups, generation jobs and metrics, one a line of RFC 4180 with a header: key, kind, name,
/// revision, method label, replicate, seed, parent, outcome, reason, wall_s, cpu_s, peak_rss_bytes, timing, commit,
/// dirty, compiler, host, cpu_model, threads, start_utc, end_utc.
std::string records_csv(std::span<const RunGroup> groups);

} // namespace tamp
