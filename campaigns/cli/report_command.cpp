// tamp report: writes a campaign's tables, or checks them against what is expected.
#include "campaigns/campaign.h"
#include "campaigns/cli/command.h"
#include "campaigns/cli/open_store.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "report/report.h"
#include "tamp_build_info.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

struct Options {
  std::string store = kDefaultStore;
  std::string file;
  std::string out;
  std::string check;
  std::string write_reference;
};

constexpr const char* kExamples =
    R"(The tables are made from what the store remembers; jobs that have not run are named below them.
Example:
  tamp report campaigns/lognormal-2d.json --out report
Whether they have moved since (exit code 1 if so), times apart:
  tamp report campaigns/lognormal-2d.json --write-reference expected.csv
  tamp report campaigns/lognormal-2d.json --check expected.csv)";

int report(const Options& options) {
  if (options.out.empty() && options.check.empty() && options.write_reference.empty())
    throw InputError("say where to write the tables: --out DIR (or --check FILE, --write-reference FILE)");
  const std::string expectation = options.check.empty() ? std::string() : read_file(options.check);
  const auto expected =
      options.check.empty() ? std::vector<ExpectedCell>() : read_expectation(expectation, options.check);
  const Plan plan = load_campaign(options.file);
  const Store store = open_for_reading(options.store);
  if (!options.out.empty()) {
    const bool watched = ::isatty(STDERR_FILENO) == 1;
    const auto show = [](std::string_view now) { fmt::print(stderr, "\r\033[Ktamp report: {}", now); };
    const auto warn = [&](std::string_view sentence) {
      fmt::print(stderr, "{}tamp report: warning: {}\n", watched ? "\r\033[K" : "", sentence);
    };
    const auto paths = write_report(plan, store, options.out, watched ? ReportProgress(show) : ReportProgress(), warn);
    if (watched)
      fmt::print(stderr, "\r\033[K");
    for (const auto& path : paths)
      fmt::print("{}\n", path.string());
  }
  if (!options.write_reference.empty()) {
    write_atomically(options.write_reference, make_expectation(plan, store, build_info::version));
    fmt::print("{}\n", options.write_reference);
  }
  if (options.check.empty())
    return kOk;
  const ExpectationCheck check = check_report(plan, store, expected);
  fmt::print("{}", in_words(check));
  return check.moved.empty() ? kOk : kNotAllOk;
}

} // namespace

void declare_report(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("report", "Write a campaign's tables in LaTeX, CSV and Markdown, or check them", kExamples,
                           [options] { return report(*options); });
  app.add_option("file", options->file, "Campaign file")->type_name("FILE")->required();
  app.add_option("--out", options->out, "Folder for the tables; made if need be")->type_name("DIR");
  app.add_option("--check", options->check, "Compare the tables with this expectation")->type_name("FILE");
  app.add_option("--write-reference", options->write_reference, "Write such an expectation")->type_name("FILE");
  add_store_option(app, options->store);
}

} // namespace tamp::cli
