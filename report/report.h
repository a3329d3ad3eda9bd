// The report of a campaign: its tables in LaTeX, CSV and Markdown, written from what the store remembers.
#pragma once

#include "engine/model/plan.h"
#include "report/runs.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tamp {

class Store;

/// All that a report is made from.
struct ReportInput {
  const Plan& plan;
  std::span<const Run> runs;        ///< collect_runs(plan, …)
  std::string command;              ///< that would run the jobs that are missing
  std::string store = "tamp-store"; ///< folder of the results, as commands name it
};

struct ReportFile {
  std::string name;
  std::string bytes;
};

/// The files of a report, the same bytes for the same input: for each of the plan's tables NAME.tex (a fragment for
/// \input), NAME.csv and NAME_records.csv, before them those of the table "decision" where methods can be compared;
/// tables.tex, a document of all fragments; report.md; index.html, a page of all. Throws InputError if the plan asks
/// for no table or for an unknown one, naming the known ones.
std::vector<ReportFile> make_report(const ReportInput& input);

/// Writes the report into the folder `out`, which it makes if need be; each file appears whole or not at all. Returns
/// the paths. Throws Error if the store cannot be read or the folder not written.
std::vector<std::filesystem::path> write_report(const Plan& plan, const Store& store, const std::filesystem::path& out);

} // namespace tamp
