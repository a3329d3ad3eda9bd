// tamp results: prints what has been found, for other programs.
#include "campaigns/cli/command.h"
#include "campaigns/cli/open_store.h"
#include "store/results_export.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

namespace tamp::cli {

namespace {

struct Options {
  std::string store = kDefaultStore;
  std::string format = "json";
  std::string campaign;
};

constexpr const char* kExamples =
    R"(One row per generation job that has run: its key, scene, outcome, times and everything measured on its packing.
Examples:
  tamp results --format csv > results.csv
  tamp results --format json --campaign lognormal-2d | jq '.[].measures.phi_paper.value')";

} // namespace

void declare_results(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("results", "Print all results as JSON or CSV", kExamples, [options] {
    const Store store = open_for_reading(options->store);
    const std::vector<ResultRow> rows = results(store, options->campaign);
    fmt::print("{}", options->format == "csv" ? results_csv(rows) : results_json(rows));
    return kOk;
  });
  app.add_option("--format", options->format, "json or csv")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"json", "csv"}))
      ->capture_default_str();
  app.add_option("--campaign", options->campaign, "Only this campaign")->type_name("NAME");
  add_store_option(app, options->store);
}

} // namespace tamp::cli
