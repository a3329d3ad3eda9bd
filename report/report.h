// The report of a campaign: its tables and figures, written from what the store remembers.
#pragma once

#include "engine/model/packing.h"
#include "engine/model/plan.h"
#include "report/expectation.h"
#include "report/figures/make_figures.h"
#include "report/runs.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

class Store;

/// Told what the report is about to work on: "records", "tables", "figures", "page".
using ReportProgress = std::function<void(std::string_view now)>;

/// Told what the report could not do though the records promise it, each in a sentence with the command that helps.
using ReportWarning = std::function<void(std::string_view sentence)>;

/// All that a report is made from.
struct ReportInput {
  const Plan& plan;
  std::span<const Run> runs;        ///< collect_runs(plan, …)
  std::string command;              ///< that would run the jobs that are missing
  std::string store = "tamp-store"; ///< folder of the results, as commands name it
  /// Reads the packing of a key, or throws Error; without it the page shows no packings.
  std::function<Packing(const std::string& key)> packing = {};
  FigureSettings figures = {};
  ReportProgress progress = {};
  ReportWarning warn = {};
};

struct ReportFile {
  std::string name;
  std::string bytes;
};

/// The files of a report, the same bytes for the same input: for each of the plan's tables NAME.tex (a fragment for
/// \input), NAME.csv and NAME_records.csv, before them those of the table "decision" where methods can be compared;
/// the figures' files (report/figures/); tables.tex, a document of all; report.md; index.html, a page of all. Throws
/// InputError if the plan asks for no table or for an unknown one, naming the known ones.
std::vector<ReportFile> make_report(const ReportInput& input);

/// The tables of that report.
std::vector<Table> report_tables(const ReportInput& input);

/// Every job of the plan with its records.
std::vector<Run> runs_in(const Store& store, const Plan& plan);

/// The campaign's tables as an expectation (report/expectation.h), and their check against one.
std::string make_expectation(const Plan& plan, const Store& store, std::string_view version);
ExpectationCheck check_report(const Plan& plan, const Store& store, std::span<const ExpectedCell> expected);

/// Writes the report into the folder `out`, which it makes if need be; each file appears whole or not at all. Files
/// that an earlier report wrote there and this one has not are removed (report/manifest.h). Returns the paths of the
/// files. Throws Error if the store cannot be read or the folder not written.
std::vector<std::filesystem::path> write_report(const Plan& plan, const Store& store, const std::filesystem::path& out,
                                                ReportProgress progress = {}, ReportWarning warn = {});

} // namespace tamp
