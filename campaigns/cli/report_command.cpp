// tamp report: writes a campaign's tables.
#include "campaigns/campaign.h"
#include "campaigns/cli/command.h"
#include "campaigns/cli/open_store.h"
#include "report/report.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

namespace tamp::cli {

namespace {

struct Options {
  std::string store = kDefaultStore;
  std::string file;
  std::string out;
};

constexpr const char* kExamples =
    R"(The tables are made from what the store remembers; jobs that have not run are named below them.
Example:
  tamp report campaigns/lognormal-2d.json --out report)";

} // namespace

void declare_report(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("report", "Write a campaign's tables in LaTeX, CSV and Markdown", kExamples, [options] {
    const Plan plan = load_campaign(options->file);
    const Store store = open_for_reading(options->store);
    for (const auto& path : write_report(plan, store, options->out))
      fmt::print("{}\n", path.string());
    return kOk;
  });
  app.add_option("file", options->file, "Campaign file")->type_name("FILE")->required();
  app.add_option("--out", options->out, "Folder for the tables; made if need be")->type_name("DIR")->required();
  add_store_option(app, options->store);
}

} // namespace tamp::cli
