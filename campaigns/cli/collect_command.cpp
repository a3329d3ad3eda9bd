// tamp collect: takes in what a cluster has done, once or until all is done, and measures it.
#include "campaigns/cli/collect.h"
#include "campaigns/cli/command.h"
#include "campaigns/cli/interrupt.h"
#include "campaigns/cli/local_run.h"
#include "campaigns/cli/names.h"
#include "campaigns/cli/open_store.h"
#include "campaigns/cli/progress.h"
#include "engine/base/error.h"
#include "engine/schedule/slurm.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;
using Seconds = std::chrono::duration<double>;

/// Pauses between two looks double from the first to the last while nothing new comes.
constexpr Seconds kFirstPause(1);
constexpr Seconds kLastPause(60);

struct Options {
  std::string store = kDefaultStore;
  bool wait = false;
  bool measure = true;
  Resources resources = machine_resources();
};

struct Pass {
  OutcomeCounts counts{};
  std::size_t open = 0;
  std::size_t refused = 0; ///< of these
  bool settling = false;
};

/// All submissions, once. Nothing if Slurm does not answer.
std::optional<Pass> look(Store& store, std::vector<Collector>& collectors) {
  ElementStates states;
  try {
    states = queue_states();
  } catch (const SlurmUnreachable& e) {
    fmt::print(stderr, "{}\n", e.what());
    return std::nullopt;
  }
  Pass pass;
  for (Collector& collector : collectors) {
    const Collected found = collector.look(store, states);
    for (const Record& record : found.records) {
      ++pass.counts[static_cast<std::size_t>(record.outcome)];
      if (record.outcome != Outcome::ok)
        fmt::print("{}: {}: {}\n", short_key(record.key), name_of(record.outcome), record.reason);
    }
    for (const std::string& complaint : found.complaints)
      fmt::print(stderr, "a result cannot be taken in and stays where it is, for another `tamp collect`: {}\n",
                 complaint);
    pass.open += found.open;
    pass.refused += found.refused;
    pass.settling = pass.settling || found.settling;
    if (collector.done())
      fs::remove_all(collector.submission().folder);
  }
  std::erase_if(collectors, [](const Collector& collector) { return collector.done(); });
  return pass;
}

/// Leaves to this run the metrics on packings that are there, and nothing else.
void keep_metrics(Agenda& agenda) {
  for (Item& item : agenda.items) {
    const bool has_packing = item.after && agenda.items[*item.after].standing == Standing::recorded;
    if (item.standing == Standing::open && (item.kind == JobKind::generation || !has_packing))
      item.standing = Standing::barred;
  }
}

/// Measures what is there of the campaigns; how many metrics ended otherwise than ok.
std::size_t measure(Store& store, const std::set<fs::path>& files, const Options& options, std::stop_token stop) {
  std::vector<std::string> names;
  for (const fs::path& file : files) {
    if (fs::exists(file))
      names.push_back(file.string());
    else
      fmt::print(stderr, "{} is gone: its metrics are left to `tamp run`\n", file.string());
  }
  const std::vector<Plan> plans = load_campaigns(names);
  Agenda agenda = make_agenda(plans, known_to(store));
  keep_metrics(agenda);
  if (agenda.count(Standing::open) == 0)
    return 0;
  Progress progress(stderr, ::isatty(STDERR_FILENO) == 1, options.resources.cores);
  const Summary summary = run_here(store, agenda, options.resources, progress, stop);
  progress.close();
  fmt::print("metrics: {}\n", in_words(summary.ran));
  return total(summary.ran) - summary.ran[static_cast<std::size_t>(Outcome::ok)];
}

/// Sleeps, but not beyond a stop request.
void pause(Seconds length, const std::stop_token& stop) {
  const auto end = std::chrono::steady_clock::now() + length;
  while (!stop.stop_requested() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

int collect(const Options& options) {
  const Interrupt interrupt;
  open_for_reading(options.store); // says so if there is none
  Store store = Store::open(options.store, Store::Mode::create);
  std::vector<Collector> collectors;
  std::set<fs::path> files;
  double settle_s = 0;
  for (Submission& submission : submissions(store)) {
    files.insert(submission.campaigns.begin(), submission.campaigns.end());
    settle_s = std::max(settle_s, submission.settle_s);
    collectors.emplace_back(std::move(submission));
  }
  if (collectors.empty()) {
    fmt::print("nothing is on a cluster\n");
    return kOk;
  }

  OutcomeCounts counts{};
  std::size_t bad_metrics = 0;
  std::optional<Pass> pass;
  Seconds length = kFirstPause;
  for (bool again = true; again && !interrupt.token().stop_requested();) {
    {
      const FileLock lock = options.wait
                                ? FileLock::lock(store.jobs_lock())
                                : hold(store); // not during the pauses, so that others can submit and run meanwhile
      pass = look(store, collectors);
      if (pass && total(pass->counts) > 0 && options.measure)
        bad_metrics += measure(store, files, options, interrupt.token());
    }
    if (pass) {
      for (std::size_t o = 0; o < counts.size(); ++o)
        counts[o] += pass->counts[o];
    }
    const bool news = pass && total(pass->counts) > 0;
    length = news ? kFirstPause : std::min(2 * length, kLastPause);
    // A single look still lasts until what is gone can be judged.
    again = pass ? pass->open > pass->refused && (options.wait || pass->settling) : options.wait;
    if (again)
      pause(pass && pass->settling ? std::min(length, Seconds(std::max(settle_s / 2, 0.1))) : length,
            interrupt.token());
  }
  fmt::print("collected: {} ({})\n", total(counts), in_words(counts));
  if (!pass)
    return kNotAllOk;
  if (pass->open > pass->refused)
    fmt::print("still on the cluster: {}\n", pass->open - pass->refused);
  if (pass->refused > 0)
    fmt::print("not taken in: {}; a damaged result is given up by removing its folder\n", pass->refused);
  if (interrupt.token().stop_requested())
    return kCancelled;
  const bool all_ok = total(counts) == counts[static_cast<std::size_t>(Outcome::ok)];
  return all_ok && bad_metrics == 0 && pass->refused == 0 ? kOk : kNotAllOk;
}

constexpr const char* kExamples =
    R"(Imports the results of `tamp submit` that are there, measures them, and judges jobs that have gone without a result:
time-limited, memory-limited, cancelled or lost, as Slurm says. Slurm's accounting (sacct) is used where there is one.
Any number of calls does no harm. Exit codes: 0 all collected is ok; 1 some is not, or Slurm does not answer.
Examples:
  tamp collect --store results
  tamp collect --store results --wait --no-metrics)";

} // namespace

void declare_collect(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app =
      line.add("collect", "Take in what a cluster has done", kExamples, [options] { return collect(*options); });
  app.add_flag("--wait", options->wait, "Go on until everything submitted has ended");
  app.add_flag("!--no-metrics", options->measure, "Leave the metrics to a later `tamp run`");
  app.add_option("--cores", options->resources.cores, "Metrics at a time, and threads of each; default: all cores")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  add_store_option(app, options->store);
}

} // namespace tamp::cli
