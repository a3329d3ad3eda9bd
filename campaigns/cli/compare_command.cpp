// tamp compare: sets two stores, two methods or two versions side by side, with the significance of each difference.
#include "campaigns/cli/command.h"
#include "campaigns/cli/open_store.h"
#include "engine/base/error.h"
#include "report/comparison.h"
#include "store/results_export.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

using Json = nlohmann::json;

struct Options {
  std::string a;
  std::string b;
  std::string by = "store";
  std::string store = kDefaultStore;
  std::string campaign;
  std::string format = "text";
};

constexpr const char* kExamples =
    R"(Runs of the same scene are compared: in pairs where each has a partner made by the same job or from the same
packing, else as independent samples.
Examples:
  tamp compare old-store new-store
  tamp compare --by method "D&R" "D&R-ME" --campaign quickstart
  tamp compare --by commit 01c6e16 fcfab4c --format csv > changes.csv)";

/// Key of the job at the start of the way that led to a packing. Only runs with a common one share anything by chance:
/// random numbers, radii too, are named by the key of their job.
std::string origin(const Store& store, Record record) {
  while (!record.parent.empty()) {
    auto parent = store.find(record.parent);
    if (!parent)
      return record.parent;
    record = std::move(*parent);
  }
  return record.key;
}

/// A result as one run of a side. What method or version is compared is no part of its scene.
ComparedRun compared(const Store& store, const ResultRow& row, bool by_method) {
  const Record& record = row.generation;
  const Json job = Json::parse(record.canonical);
  Json scene = {{"scene", job.at("scene")}};
  if (!by_method) {
    Json method = job.at("method");
    method.erase("revision");
    scene["method"] = method;
  }
  ComparedRun run;
  run.scene = scene.dump();
  run.pair = origin(store, record);
  run.key = record.key;
  run.digest = record.packing_sha256;
  for (const Measure& measure : row.measures)
    run.measures.emplace(measure.unit == "1" ? measure.name : measure.name + " [" + measure.unit + "]", measure.value);
  if (record.timing.mode == TimingMode::exclusive) // beside other jobs a time says little
    run.measures.emplace("time [s]", record.timing.wall_s);
  return run;
}

bool belongs(const ResultRow& row, const std::string& by, const std::string& side) {
  if (by == "method")
    return row.label == side;
  return by == "store" || row.generation.provenance.commit.starts_with(side);
}

/// The runs that ended ok of one side. Throws InputError if there is none.
std::vector<ComparedRun> side_of(const Options& options, const std::string& side) {
  const Store store = open_for_reading(options.by == "store" ? side : options.store);
  std::vector<ComparedRun> runs;
  std::set<std::string> keys; // a job may belong to several campaigns
  for (const ResultRow& row : results(store, options.campaign)) {
    if (row.generation.outcome == Outcome::ok && belongs(row, options.by, side) &&
        keys.insert(row.generation.key).second)
      runs.push_back(compared(store, row, options.by == "method"));
  }
  if (runs.empty())
    throw InputError(fmt::format("no run that ended ok belongs to the {} \"{}\"", options.by, side));
  return runs;
}

int compare(const Options& options) {
  const Comparison comparison = compare_runs(side_of(options, options.a), side_of(options, options.b));
  if (options.format == "csv")
    fmt::print("{}", comparison_csv(comparison));
  else if (options.format == "json")
    fmt::print("{}", comparison_json(comparison, options.a, options.b));
  else
    fmt::print("{}", comparison_text(comparison, options.a, options.b));
  return kOk;
}

} // namespace

void declare_compare(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("compare", "Set two stores, methods or versions side by side", kExamples,
                           [options] { return compare(*options); });
  app.add_option("a", options->a, "Folder of a store, label of a method, or commit")->type_name("A")->required();
  app.add_option("b", options->b, "The same for the other side")->type_name("B")->required();
  app.add_option("--by", options->by, "What A and B are: store, method or commit")
      ->type_name("KIND")
      ->check(CLI::IsMember({"store", "method", "commit"}))
      ->capture_default_str();
  app.add_option("--campaign", options->campaign, "Only this campaign")->type_name("NAME");
  app.add_option("--format", options->format, "text, csv or json")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"text", "csv", "json"}))
      ->capture_default_str();
  add_store_option(app, options->store);
}

} // namespace tamp::cli
