// tamp run: runs what is missing of campaigns.
#include "campaigns/cli/command.h"
#include "campaigns/cli/interrupt.h"
#include "campaigns/cli/local_run.h"
#include "campaigns/cli/names.h"
#include "campaigns/cli/open_store.h"
#include "campaigns/cli/progress.h"
#include "campaigns/cli/shared_run.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

struct Options {
  std::vector<std::string> files;
  std::string store = kDefaultStore;
  Resources resources = machine_resources();
  bool retry_limited = false;
  bool wait = false;
  bool join = false;
};

void report_sweep(const Sweep& sweep, Progress& progress) {
  if (!sweep.imported.empty())
    progress.say(fmt::format("took in {} results that an earlier run had left", sweep.imported.size()));
  for (const std::string& message : sweep.rejected)
    progress.say(fmt::format("an earlier run had left a damaged result, which is made anew: {}", message));
}

void print_summary(const Summary& summary, const std::string& store) {
  fmt::print("jobs run: {} ({})\n", total(summary.ran), in_words(summary.ran));
  if (total(summary.recorded) > 0)
    fmt::print("recorded before: {} ({})\n", total(summary.recorded), in_words(summary.recorded));
  if (summary.barred > 0)
    fmt::print("not possible, as their packing was not made: {}\n", summary.barred);
  if (summary.cancelled > 0)
    fmt::print("cancelled: {}; the same command goes on with them\n", summary.cancelled);
  fmt::print("store: {}\n", store);
}

int exit_code(const Summary& summary) {
  if (summary.cancelled > 0)
    return kCancelled;
  return summary.all_ok() ? kOk : kNotAllOk;
}

/// Whether a job that is to be run has the machine for itself.
bool has_exclusive(const Agenda& agenda) {
  return std::any_of(agenda.items.begin(), agenda.items.end(), [&](const Item& item) {
    return item.kind == JobKind::generation && item.standing == Standing::open &&
           agenda.task(item).run.timing == TimingMode::exclusive;
  });
}

int run(const Options& options) {
  const std::vector<Plan> plans = load_campaigns(options.files); // before anything is made
  const Interrupt interrupt;
  Store store = Store::open(options.store, Store::Mode::create);
  const InUse in_use = options.join ? InUse::join : options.wait ? InUse::wait : InUse::complain;
  std::optional<Seat> seat = Seat::take(store.folder(), in_use, interrupt.token());
  if (!seat)
    return kCancelled;
  Progress progress(stderr, ::isatty(STDERR_FILENO) == 1, options.resources.cores);
  if (!store.network().empty())
    progress.say(fmt::format(
        "the store lies on a network file system ({}): its database does without a write-ahead log", store.network()));
  if (seat->is_alone()) {
    report_sweep(store.sweep_incoming(), progress);
    sweep_working_files(store);
  }
  for (const Plan& plan : plans)
    store.put_campaign(plan);

  Agenda agenda = make_agenda(plans, known_to(store, options.retry_limited ? Limited::open : Limited::done, plans));
  if (agenda.count(Standing::open) == 0) {
    const Summary summary{.recorded = recorded_outcomes(agenda), .barred = agenda.count(Standing::barred)};
    fmt::print("nothing to do: {} jobs already recorded ({})\n", total(summary.recorded), in_words(summary.recorded));
    const auto limited = [&](Outcome outcome) { return summary.recorded[static_cast<std::size_t>(outcome)]; };
    if (limited(Outcome::time_limited) + limited(Outcome::memory_limited) > 0)
      fmt::print("with a raised budget, --retry-limited runs those again that ran out of time or memory\n");
    return exit_code(summary);
  }
  if (has_exclusive(agenda))
    seat->keep_alone();
  else
    seat->open();
  const Summary summary = run_shared(store, plans, std::move(agenda), options.resources, progress, interrupt.token());
  progress.close();
  print_summary(summary, options.store);
  return exit_code(summary);
}

constexpr const char* kExamples =
    R"(A job is one packing, or one metric on a packing. What is recorded already is not run again, so the same command
continues after Ctrl-C, a crash or an added replicate. Jobs that failed are tried again; those that ran out of time or
memory only with --retry-limited, as they would end in the same way unless their budgets have been raised.
Examples:
  tamp run campaigns/quickstart.json
  tamp run --store results --cores 8 campaigns/lognormal-2d.json campaigns/lognormal-3d.json

Exit codes: 0 every job is recorded as ok; 1 some job is not (see `tamp status`), or the system failed; 2 a campaign
file is at fault, nothing was written; 130 cancelled. The second Ctrl-C ends the program at once; that harms nothing.)";

} // namespace

void declare_run(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("run", "Run what is missing of campaigns", kExamples, [options] { return run(*options); });
  app.add_option("files", options->files, "Campaign files")->type_name("FILE")->required();
  app.add_option("--cores", options->resources.cores, "Jobs at a time, and threads of metrics; default: all cores")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  app.add_option_function<double>(
         "--memory",
         [options](const double& megabytes) {
           options->resources.memory_bytes = static_cast<std::uint64_t>(megabytes * 1e6);
         },
         "Memory that the budgets of jobs running at a time may add up to, in MB; default: all memory")
      ->type_name("MB")
      ->check(CLI::PositiveNumber);
  app.add_flag("--retry-limited", options->retry_limited,
               "Run jobs again that ran out of time, and those that ran out of less memory than they may have now");
  CLI::Option* wait = app.add_flag("--wait", options->wait, "If another run has the store: wait for its end");
  app.add_flag("--join", options->join, "If another run has the store: work beside it on other jobs")->excludes(wait);
  add_store_option(app, options->store);
}

} // namespace tamp::cli
