// Notes on the records behind a table, and the list of those records.
#include "report/csv.h"
#include "report/notes.h"

#include <fmt/format.h>

#include <array>
#include <map>

namespace tamp {

namespace {

/// Calls visit(group, run, record) for each record of the groups, a packing's metrics after its generation.
template <class Visit>
void each_record(std::span<const RunGroup> groups, Visit visit) {
  for (const RunGroup& group : groups) {
    for (const Run& run : group.runs) {
      if (run.generation)
        visit(group, run, *run.generation);
      for (const MetricRun& metric : run.metrics) {
        if (metric.record)
          visit(group, run, *metric.record);
      }
    }
  }
}

std::string libraries_in_words(const std::map<std::string, std::string>& libraries) {
  std::string words;
  for (const auto& [name, version] : libraries)
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", name, version);
  return words;
}

std::string build_in_words(const Provenance& p) {
  return fmt::format("commit {}{}, {}, flags \"{}\", {}", short_key(p.commit),
                     p.dirty ? " with changes that are not in it" : "", p.compiler, p.flags,
                     libraries_in_words(p.libraries));
}

std::string machine_in_words(const Provenance& p) {
  return fmt::format("{}, {}, {} hardware threads, {}", p.host, p.cpu_model, p.hardware_threads, p.kernel);
}

std::string with_counts(const std::map<std::string, std::size_t>& counts) {
  std::string text;
  for (const auto& [words, count] : counts)
    text += fmt::format("{}{} ({} records)", text.empty() ? "" : "; ", words, count);
  return text;
}

/// "2024-05-01T08:00:00.123456Z" without the fraction.
std::string to_the_second(const std::string& utc) {
  const std::size_t point = utc.find('.');
  return point == std::string::npos ? utc : utc.substr(0, point) + "Z";
}

/// With more groups the list of keys is longer than the table; the file of records has them all.
constexpr std::size_t kGroupsWithKeys = 6;

std::string keys_note(const NotesInput& input) {
  std::string text = fmt::format("Campaign {} from {}.", input.plan.campaign, input.plan.file);
  if (input.groups.size() > kGroupsWithKeys)
    return text + fmt::format(" All records with their keys: {}_records.csv.", input.table);
  text += " Keys of the packings:";
  for (const RunGroup& group : input.groups) {
    std::string keys;
    for (const Run& run : group.runs) {
      if (run.ok())
        keys += (keys.empty() ? " " : ", ") + short_key(run.planned.key);
    }
    if (!keys.empty())
      text += fmt::format(" {}:{}.", group.heading, keys);
  }
  return text + fmt::format(" All records with full keys: {}_records.csv.", input.table);
}

} // namespace

std::string short_key(const std::string& key) {
  return key.substr(0, 12);
}

std::vector<Note> provenance_notes(const NotesInput& input) {
  std::map<std::string, std::size_t> builds;
  std::map<std::string, std::size_t> machines;
  std::string first;
  std::string last;
  each_record(input.groups, [&](const RunGroup&, const Run&, const Record& record) {
    const Provenance& p = record.provenance;
    ++builds[build_in_words(p)];
    ++machines[machine_in_words(p)];
    if (first.empty() || p.start_utc < first)
      first = p.start_utc;
    if (p.end_utc > last)
      last = p.end_utc;
  });
  if (builds.empty())
    return {{"Records", fmt::format("Campaign {} from {}. None yet.", input.plan.campaign, input.plan.file)}};
  return {{"Records", keys_note(input)},
          {"Build", with_counts(builds) + "."},
          {"Machine", with_counts(machines) + "."},
          {"Dates", fmt::format("from {} to {}.", to_the_second(first), to_the_second(last))}};
}

std::string records_csv(std::span<const RunGroup> groups) {
  std::string out = "key,kind,name,revision,label,replicate,seed,parent,outcome,reason,wall_s,cpu_s,peak_rss_bytes,"
                    "timing,commit,dirty,compiler,host,cpu_model,threads,start_utc,end_utc\n";
  each_record(groups, [&](const RunGroup& group, const Run& run, const Record& record) {
    const Provenance& p = record.provenance;
    const Timing& t = record.timing;
    const std::array<std::string, 22> fields = {record.key,
                                                std::string(name_of(record.kind)),
                                                record.name,
                                                std::to_string(record.revision),
                                                group.heading,
                                                std::to_string(run.planned.job.replicate),
                                                std::to_string(run.planned.job.seed),
                                                record.parent,
                                                std::string(name_of(record.outcome)),
                                                record.reason,
                                                csv_number(t.wall_s),
                                                csv_number(t.cpu_s),
                                                std::to_string(t.peak_rss_bytes),
                                                std::string(name_of(t.mode)),
                                                p.commit,
                                                p.dirty ? "true" : "false",
                                                p.compiler,
                                                p.host,
                                                p.cpu_model,
                                                std::to_string(p.threads),
                                                p.start_utc,
                                                p.end_utc};
    out += csv_record(fields);
  });
  return out;
}

} // namespace tamp
