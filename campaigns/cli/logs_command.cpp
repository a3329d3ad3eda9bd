// tamp logs: prints what a job said, and how its attempts ended.
#include "campaigns/cli/command.h"
#include "campaigns/cli/names.h"
#include "campaigns/cli/open_store.h"
#include "engine/base/files.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

namespace tamp::cli {

namespace {

struct Options {
  std::string key;
  std::string store = kDefaultStore;
};

int logs(const Options& options) {
  const Store store = open_for_reading(options.store);
  const std::string key = whole_key(store, options.key);
  int number = 0;
  for (const Record& attempt : store.attempts(key)) {
    fmt::print("# attempt {}: {}, {} to {}, {} on {}, process {}\n", ++number, attempt.name,
               attempt.provenance.start_utc, attempt.provenance.end_utc, name_of(attempt.outcome),
               attempt.provenance.host, attempt.provenance.pid);
    if (!attempt.reason.empty())
      fmt::print("{}\n", attempt.reason);
  }
  const std::filesystem::path file = store.log_path(key);
  if (!std::filesystem::exists(file)) {
    fmt::print("# the latest attempt said nothing\n");
    return kOk;
  }
  const std::string text = read_file(file);
  fmt::print("# what the latest attempt said ({}):\n{}{}", file.string(), text, text.ends_with('\n') ? "" : "\n");
  return kOk;
}

constexpr const char* kExamples =
    R"(Every attempt at the job with its outcome and reason, and the whole output of the latest one.
Example:
  tamp logs --store results 3fa91c)";

} // namespace

void declare_logs(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("logs", "Print what a job said, and how its attempts ended", kExamples,
                           [options] { return logs(*options); });
  app.add_option("key", options->key, "Key of a job, or its first digits")->type_name("KEY")->required();
  add_store_option(app, options->store);
}

} // namespace tamp::cli
