// tamp plan: shows what `tamp run` would do, and does nothing.
#include "campaigns/cli/command.h"
#include "campaigns/cli/flow_dot.h"
#include "campaigns/cli/names.h"
#include "campaigns/cli/open_store.h"
#include "campaigns/cli/plan_costs.h"
#include "campaigns/cli/plan_effects.h"
#include "engine/base/files.h"
#include "engine/schedule/resources.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

struct Options {
  std::vector<std::string> files;
  std::string store = kDefaultStore;
  std::string dot;
  bool dot_jobs = false;
};

std::string standing_in_words(const Item& item) {
  switch (item.standing) {
  case Standing::recorded:
    return fmt::format("recorded: {}", name_of(*item.recorded));
  case Standing::barred:
    return "not possible: its parent has no packing";
  case Standing::open:
    break;
  }
  return "to run";
}

void print_campaign(const Plan& plan) {
  fmt::print("{}: {}\n", plan.campaign, plan.title.empty() ? plan.file : plan.title);
  fmt::print("  {} packings, {} metrics on each; timing {}; budgets {:g} s and {} MB a job\n", plan.jobs.size(),
             plan.metrics.size(), name_of(plan.run.timing), plan.run.wall_s, plan.run.memory_mb);
}

/// One line a generation: its name, how it stands, how many of its metrics are recorded.
void print_jobs(const Agenda& agenda) {
  for (std::size_t i = 0; i < agenda.items.size();) {
    const Item& generation = agenda.items[i];
    const Task& task = agenda.task(generation);
    std::size_t recorded = 0;
    for (++i; i < agenda.items.size() && agenda.items[i].kind == JobKind::metric; ++i)
      recorded += agenda.items[i].standing == Standing::recorded ? 1U : 0U;
    fmt::print("  {}  {}: {}; {} of {} metrics recorded\n", short_key(generation.key),
               job_name(task.planned.label, task.planned.point, task.planned.job.replicate),
               standing_in_words(generation), recorded, task.metrics.size());
  }
}

int plan(const Options& options) {
  const std::vector<Plan> plans = load_campaigns(options.files);
  std::optional<Store> store;
  if (store_exists(options.store))
    store = Store::open(options.store, Store::Mode::read);
  const Agenda agenda =
      make_agenda(plans, store ? known_to(*store) : Known([](const std::string&) { return std::nullopt; }));

  if (!options.dot.empty())
    write_atomically(options.dot, flow_dot(agenda, options.dot_jobs ? FlowDetail::jobs : FlowDetail::methods));

  for (const Plan& one : plans) {
    print_campaign(one);
    fmt::print("{}", effects_in_words(one));
  }
  print_jobs(agenda);
  fmt::print("{} jobs: {} recorded ({}), {} to run", agenda.items.size(), agenda.count(Standing::recorded),
             in_words(recorded_outcomes(agenda)), agenda.count(Standing::open));
  if (const std::size_t barred = agenda.count(Standing::barred); barred > 0)
    fmt::print(", {} not possible", barred);
  fmt::print("\n");
  if (store)
    fmt::print("{}", costs_in_words(agenda, *store, machine_resources().cores));
  return kOk;
}

constexpr const char* kExamples =
    R"(Checks the files, tells which effects will be simulated, which left out and by which rule, lists every
packing with its key and how it stands in the store, counts, and says what the rest will take in time
and memory, learned from the records of the store. Writes nothing, but with --dot the graph of what waits for what, for Graphviz.
Examples:
  tamp plan campaigns/*.json
  tamp plan --store results campaigns/lognormal-2d.json | grep 'to run'
  tamp plan campaigns/quickstart.json --dot flow.dot && dot -Tsvg flow.dot > flow.svg)";

} // namespace

void declare_plan(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app =
      line.add("plan", "Show what a run would do, without doing it", kExamples, [options] { return plan(*options); });
  app.add_option("files", options->files, "Campaign files")->type_name("FILE")->required();
  CLI::Option* dot =
      app.add_option("--dot", options->dot, "Write the flow graph: methods and metrics with counts")->type_name("FILE");
  app.add_flag("--dot-jobs", options->dot_jobs, "A node of it for each job")->needs(dot);
  add_store_option(app, options->store);
}

} // namespace tamp::cli
