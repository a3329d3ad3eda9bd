// Joins campaigns into one list of jobs without doubles.
#include "engine/schedule/agenda.h"

#include "engine/base/error.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace tamp {

namespace {

RunSettings joined(const RunSettings& a, const RunSettings& b) {
  return {.wall_s = std::max(a.wall_s, b.wall_s),
          .cpu_s = std::min(a.cpu_s, b.cpu_s) > 0 ? std::max(a.cpu_s, b.cpu_s) : 0,
          .memory_mb = std::max(a.memory_mb, b.memory_mb),
          .timing = a.timing == TimingMode::exclusive ? a.timing : b.timing,
          .samples = std::max(a.samples, b.samples)};
}

void add_metrics(Task& task, const std::vector<Metric>& metrics) {
  for (const Metric& metric : metrics) {
    const std::string key = metric_key(metric, task.planned.key);
    const bool there = std::any_of(task.metrics.begin(), task.metrics.end(),
                                   [&](const Metric& other) { return metric_key(other, task.planned.key) == key; });
    if (!there)
      task.metrics.push_back(metric);
  }
}

/// The jobs of a plan in the order in which they are to run: that of the file, but of jobs that are timed alone first
/// the first replicates of all methods and points, then the second ones, so that a drift of the machine meets all
/// alike.
std::vector<const PlannedJob*> in_turn(const Plan& plan) {
  std::vector<const PlannedJob*> jobs;
  for (const PlannedJob& planned : plan.jobs)
    jobs.push_back(&planned);
  if (plan.run.timing == TimingMode::exclusive)
    std::stable_sort(jobs.begin(), jobs.end(),
                     [](const PlannedJob* a, const PlannedJob* b) { return a->job.replicate < b->job.replicate; });
  return jobs;
}

/// One task per key, in the order of the campaigns.
std::vector<Task> join_tasks(std::span<const Plan> plans) {
  std::vector<Task> tasks;
  std::unordered_map<std::string, std::size_t> task_of;
  for (const Plan& plan : plans) {
    for (const PlannedJob* planned : in_turn(plan)) {
      const auto [found, is_new] = task_of.try_emplace(planned->key, tasks.size());
      if (is_new)
        tasks.push_back({*planned, plan.run, {}});
      Task& task = tasks[found->second];
      task.run = joined(task.run, plan.run);
      add_metrics(task, plan.metrics);
    }
  }
  return tasks;
}

/// The tasks, each behind its parent. Parents cannot form a ring, as a key contains its parent's.
std::vector<Task> parents_first(std::vector<Task> tasks) {
  std::unordered_map<std::string, std::size_t> task_of;
  for (std::size_t t = 0; t < tasks.size(); ++t)
    task_of.emplace(tasks[t].planned.key, t);

  std::vector<Task> sorted;
  sorted.reserve(tasks.size());
  std::vector<char> placed(tasks.size(), 0);
  std::vector<std::size_t> chain; // a task whose ancestors are being placed, and those ancestors
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    chain.assign(1, t);
    while (!chain.empty()) {
      const auto parent = task_of.find(tasks[chain.back()].planned.job.parent);
      if (placed[chain.back()] == 0 && parent != task_of.end() && placed[parent->second] == 0) {
        chain.push_back(parent->second);
        continue;
      }
      if (std::exchange(placed[chain.back()], 1) == 0)
        sorted.push_back(std::move(tasks[chain.back()]));
      chain.pop_back();
    }
  }
  return sorted;
}

/// Standing of an item from its own record and from the item whose packing it needs.
void judge(Item& item, const Known& known, const Item* predecessor) {
  item.recorded = known(item.key);
  if (item.recorded) {
    item.standing = Standing::recorded;
  } else if (predecessor != nullptr) {
    const bool packing_missing = predecessor->standing == Standing::recorded && !leaves_packing(*predecessor->recorded);
    if (packing_missing || predecessor->standing == Standing::barred)
      item.standing = Standing::barred;
  }
}

/// The parent is not planned, so its packing must be there already.
void require_parent(const PlannedJob& planned, const Known& known) {
  const std::optional<Outcome> parent = known(planned.job.parent);
  if (!parent || !leaves_packing(*parent))
    throw Error("job " + planned.key + " starts from packing " + planned.job.parent +
                ", which is neither planned nor recorded");
}

} // namespace

std::size_t Agenda::count(Standing standing) const {
  return static_cast<std::size_t>(
      std::count_if(items.begin(), items.end(), [&](const Item& item) { return item.standing == standing; }));
}

OutcomeCounts recorded_outcomes(const Agenda& agenda) {
  OutcomeCounts counts{};
  for (const Item& item : agenda.items) {
    if (item.recorded)
      ++counts[static_cast<std::size_t>(*item.recorded)];
  }
  return counts;
}

Agenda make_agenda(std::span<const Plan> plans, const Known& known) {
  Agenda agenda;
  agenda.tasks = parents_first(join_tasks(plans));
  std::unordered_map<std::string, std::size_t> item_of; // generations
  for (std::size_t t = 0; t < agenda.tasks.size(); ++t) {
    const Task& task = agenda.tasks[t];
    const std::size_t own = agenda.items.size();
    Item generation{.kind = JobKind::generation, .key = task.planned.key, .task = t, .after = {}, .recorded = {}};
    if (const std::string& parent = task.planned.job.parent; !parent.empty()) {
      if (const auto found = item_of.find(parent); found != item_of.end())
        generation.after = found->second;
      else
        require_parent(task.planned, known);
    }
    judge(generation, known, generation.after ? &agenda.items[*generation.after] : nullptr);
    agenda.items.push_back(std::move(generation));
    item_of.emplace(task.planned.key, own);

    for (std::size_t m = 0; m < task.metrics.size(); ++m) {
      Item item{.kind = JobKind::metric,
                .key = metric_key(task.metrics[m], task.planned.key),
                .task = t,
                .metric = m,
                .after = own,
                .recorded = {}};
      judge(item, known, &agenda.items[own]);
      agenda.items.push_back(std::move(item));
    }
  }
  return agenda;
}

} // namespace tamp
