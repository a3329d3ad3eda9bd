// tamp timeline: draws when the jobs of a campaign ran.
#include "campaigns/campaign.h"
#include "campaigns/cli/command.h"
#include "campaigns/cli/open_store.h"
#include "engine/base/files.h"
#include "report/figures/timeline.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

struct Options {
  std::string store = kDefaultStore;
  std::string file;
  std::string out;
};

constexpr const char* kExamples =
    R"(Every recorded run of the campaign's jobs and metrics, from start to end, beside those that ran at the same time; a
colour for each method. Pauses between runs are cut short. Rest the mouse on a bar to read what it was.
Example:
  tamp timeline campaigns/quickstart.json --out timeline.svg)";

int timeline(const Options& options) {
  const Plan plan = load_campaign(options.file);
  const Store store = open_for_reading(options.store);
  std::vector<TimelineBar> bars;
  const auto add = [&](const std::string& key, const std::string& what) {
    for (const Record& record : store.attempts(key)) {
      if (auto bar = timeline_bar(record, what))
        bars.push_back(std::move(*bar));
    }
  };
  for (const PlannedJob& job : plan.jobs) {
    const std::string name = job_name(job.label, job.point, job.job.replicate);
    add(job.key, name);
    for (const Metric& metric : plan.metrics)
      add(metric_key(metric, job.key), fmt::format("{} of {}", name_of(metric.name), name));
  }
  write_atomically(options.out, timeline_svg(bars, plan.title.empty() ? plan.campaign : plan.title));
  fmt::print("{}\n", options.out);
  return kOk;
}

} // namespace

void declare_timeline(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("timeline", "Draw when the jobs of a campaign ran, as SVG", kExamples,
                           [options] { return timeline(*options); });
  app.add_option("file", options->file, "Campaign file")->type_name("FILE")->required();
  app.add_option("--out", options->out, "SVG to be written")->type_name("PATH")->required();
  add_store_option(app, options->store);
}

} // namespace tamp::cli
