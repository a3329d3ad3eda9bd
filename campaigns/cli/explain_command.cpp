// tamp explain: says why a job would run, or would not, and which parameter makes it another job than a recorded one.
#include "campaigns/cli/command.h"
#include "campaigns/cli/explain.h"
#include "campaigns/cli/first_line.h"
#include "campaigns/cli/names.h"
#include "campaigns/cli/open_store.h"
#include "engine/base/error.h"
#include "engine/model/parameter.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

struct Options {
  std::string what;
  std::string store = kDefaultStore;
};

/// Open jobs that are compared with all recorded ones; the rest is counted.
constexpr std::size_t kCompared = 50;

/// What the record says by itself: whether a run that asks for this very key would run it again.
std::string fate_of(const Store& store, const Record& record) {
  const bool has_packing = record.kind == JobKind::generation && leaves_packing(record.outcome);
  if (!is_final(record.outcome))
    return fmt::format("runs again: the last attempt ended as {}: {}", name_of(record.outcome),
                       first_line(record.reason));
  if (has_packing && !std::filesystem::exists(store.packing_path(record.key)))
    return fmt::format("runs again: recorded as {}, but its packing is missing", name_of(record.outcome));
  if (record.outcome == Outcome::time_limited || record.outcome == Outcome::memory_limited)
    return fmt::format("does not run again unless --retry-limited: recorded as {}", name_of(record.outcome));
  return fmt::format("does not run again: recorded as {}", name_of(record.outcome));
}

/// Recorded jobs of one method or metric, with their leaves.
struct Candidates {
  std::vector<RecordedJob> jobs;
  std::vector<Leaves> leaves;
};

class Explainer {
public:
  explicit Explainer(const Store* store) : store_(store) {}

  std::string reason(const Agenda& agenda, const Item& item) {
    if (item.standing == Standing::barred)
      return "cannot run: the packing it needs was not made";
    if (const auto record = store_ != nullptr ? store_->find(item.key) : std::nullopt)
      return fate_of(*store_, *record);
    const Task& task = agenda.task(item);
    const bool generation = item.kind == JobKind::generation;
    const std::string_view name =
        generation ? name_of(task.planned.job.method.name) : name_of(agenda.metric(item).name);
    const Leaves wanted =
        leaves_of(generation ? canonical(task.planned.job) : canonical(agenda.metric(item), task.planned.key));
    const Candidates& candidates = candidates_of(item.kind, std::string(name));
    const auto nearest = nearest_job(candidates.leaves, wanted);
    if (!nearest)
      return fmt::format("runs: nothing of {} is recorded", name);
    return fmt::format("runs: never recorded; the nearest record differs in {}",
                       in_words(differences(candidates.leaves[*nearest], wanted)));
  }

private:
  const Candidates& candidates_of(JobKind kind, const std::string& name) {
    const auto [found, is_new] = candidates_.try_emplace({kind, name});
    Candidates& candidates = found->second;
    if (is_new && store_ != nullptr) {
      candidates.jobs = store_->recorded_jobs(kind, name);
      for (const RecordedJob& job : candidates.jobs)
        candidates.leaves.push_back(leaves_of(job.canonical));
    }
    return candidates;
  }

  const Store* store_;
  std::map<std::pair<JobKind, std::string>, Candidates> candidates_;
};

std::string name_of_item(const Agenda& agenda, const Item& item) {
  const PlannedJob& planned = agenda.task(item).planned;
  const std::string packing = job_name(planned.label, planned.point, planned.job.replicate);
  return item.kind == JobKind::generation ? packing
                                          : fmt::format("{} of {}", name_of(agenda.metric(item).name), packing);
}

/// Metrics whose packing is still to be made need no reason of their own.
bool waits(const Agenda& agenda, const Item& item) {
  return item.kind == JobKind::metric && agenda.items[*item.after].standing != Standing::recorded;
}

int explain_campaign(const Options& options) {
  const std::vector<Plan> plans = load_campaigns({options.what});
  std::optional<Store> store;
  if (store_exists(options.store))
    store = Store::open(options.store, Store::Mode::read);
  const Agenda agenda =
      make_agenda(plans, store ? known_to(*store) : Known([](const std::string&) { return std::nullopt; }));
  Explainer explainer(store ? &*store : nullptr);
  std::size_t told = 0;
  std::size_t waiting = 0;
  std::size_t further = 0;
  for (const Item& item : agenda.items) {
    if (item.standing == Standing::recorded)
      continue;
    if (waits(agenda, item)) {
      ++waiting;
    } else if (++told > kCompared) {
      ++further;
    } else {
      fmt::print("{}  {}\n  {}\n", short_key(item.key), name_of_item(agenda, item), explainer.reason(agenda, item));
    }
  }
  if (further > 0)
    fmt::print("and {} more that are not recorded; `tamp plan` lists them\n", further);
  if (waiting > 0)
    fmt::print("{} metrics wait for packings that are not made yet\n", waiting);
  fmt::print("{} of {} jobs are recorded ({}) and do not run again\n", agenda.count(Standing::recorded),
             agenda.items.size(), in_words(recorded_outcomes(agenda)));
  return kOk;
}

/// The revision that this program's method or metric of the record has; nothing if it has none of that name.
std::optional<std::int64_t> present_revision(const Record& record) {
  if (record.kind == JobKind::generation) {
    const auto name = enum_of<MethodName>(record.name);
    return name ? std::optional(info(*name).revision) : std::nullopt;
  }
  const auto name = enum_of<MetricName>(record.name);
  return name ? std::optional(info(*name).revision) : std::nullopt;
}

int explain_key(const Options& options) {
  const Store store = open_for_reading(options.store);
  const Record record = *store.find(whole_key(store, options.what));
  fmt::print("{}: {} by {}, revision {}\n", record.key, name_of(record.kind), record.name, record.revision);
  const auto revision = present_revision(record);
  if (!revision) {
    fmt::print("  does not run again: this tamp has no {} of that name\n", record.name);
  } else if (*revision != record.revision) {
    fmt::print("  a campaign that asks for it runs it under another key: the revision of {} is {} recorded, {} now\n",
               record.name, record.revision, *revision);
  } else {
    fmt::print("  {}\n", fate_of(store, record));
  }
  if (!record.parent.empty()) {
    const auto parent = store.find(record.parent);
    fmt::print("  its parent {}: {}\n", short_key(record.parent),
               parent ? fate_of(store, *parent) : "not recorded in this store");
  }
  return kOk;
}

int explain(const Options& options) {
  return std::filesystem::exists(options.what) ? explain_campaign(options) : explain_key(options);
}

constexpr const char* kExamples =
    R"(For a campaign: each job that a run would start, with the reason, and for one that was never recorded the
parameters in which it differs from the recorded job nearest to it. For a key, or its first digits: whether its record
stands. Writes nothing.
Examples:
  tamp explain campaigns/lognormal-2d.json
  tamp explain --store results 3fa91c)";

} // namespace

void declare_explain(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app =
      line.add("explain", "Say why a job would run again or not", kExamples, [options] { return explain(*options); });
  app.add_option("what", options->what, "Campaign file, or key of a job")->type_name("KEY|FILE")->required();
  add_store_option(app, options->store);
}

} // namespace tamp::cli
