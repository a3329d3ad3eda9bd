// Joins jobs with records and groups replicates.
#include "report/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tamp {

namespace {

std::optional<double> find_measure(const std::vector<Measure>& measures, std::string_view name) {
  for (const Measure& measure : measures) {
    if (measure.name == name && std::isfinite(measure.value))
      return measure.value;
  }
  return std::nullopt;
}

/// What replicates have in common.
std::string common_content(const PlannedJob& planned) {
  Job job = planned.job;
  job.seed = 0;
  job.replicate = 0;
  job.parent.clear(); // replicates of a job with a parent start from different packings
  return planned.label + '\n' + canonical(job);
}

std::string in_words(const std::map<std::string, std::string>& point) {
  std::string words;
  for (const auto& [path, value] : point)
    words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", path, value);
  return words;
}

} // namespace

bool Run::ok() const {
  return generation && generation->outcome == Outcome::ok;
}

std::optional<double> Run::measure(std::string_view name) const {
  if (!generation)
    return std::nullopt;
  if (const auto value = find_measure(generation->measures, name))
    return value;
  for (const MetricRun& metric : metrics) {
    if (!metric.record || metric.record->outcome != Outcome::ok)
      continue;
    if (const auto value = find_measure(metric.record->measures, name))
      return value;
  }
  return std::nullopt;
}

const Ancestor* Run::barrier() const {
  const auto barred = std::find_if(way.rbegin(), way.rend(), [](const Ancestor& ancestor) {
    return ancestor.outcome && *ancestor.outcome != Outcome::ok;
  });
  return barred == way.rend() ? nullptr : &*barred;
}

std::optional<double> Run::way_seconds(TimingMode mode) const {
  if (!generation || !generation->timing.counts_as(mode))
    return std::nullopt;
  double sum = generation->timing.wall_s;
  for (const Ancestor& ancestor : way) {
    if (!ancestor.outcome || !ancestor.timing.counts_as(mode))
      return std::nullopt;
    sum += ancestor.timing.wall_s;
  }
  return sum;
}

namespace {

/// Jobs and records of a campaign by key, to follow parents through.
class Ancestry {
public:
  Ancestry(const Plan& plan, const FindRecord& find) : find_(find) {
    for (const PlannedJob& planned : plan.jobs)
      planned_.emplace(planned.key, &planned);
  }

  std::vector<Ancestor> of(const std::string& parent) {
    if (parent.empty())
      return {};
    if (const auto known = known_.find(parent); known != known_.end())
      return known->second;
    const auto record = find_(parent);
    const auto planned = planned_.find(parent);
    std::vector<Ancestor> way{{parent, parent, {}}};
    std::string next;
    if (planned != planned_.end()) {
      way[0].label = planned->second->label;
      next = planned->second->job.parent;
    }
    if (record) {
      way[0].outcome = record->outcome;
      way[0].timing = record->timing;
      next = record->parent;
    }
    const std::vector<Ancestor> before = of(next);
    way.insert(way.end(), before.begin(), before.end());
    return known_[parent] = way;
  }

private:
  const FindRecord& find_;
  std::map<std::string, const PlannedJob*> planned_;
  std::map<std::string, std::vector<Ancestor>> known_;
};

} // namespace

std::vector<Run> collect_runs(const Plan& plan, const FindRecord& find) {
  std::vector<Run> runs;
  runs.reserve(plan.jobs.size());
  Ancestry ancestry(plan, find);
  for (const PlannedJob& planned : plan.jobs) {
    Run run{planned, find(planned.key), {}, ancestry.of(planned.job.parent)};
    for (const Metric& metric : plan.metrics) {
      std::string key = metric_key(metric, planned.key);
      auto record = find(key);
      run.metrics.push_back({metric, std::move(key), std::move(record)});
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

std::size_t RunGroup::ok_count() const {
  return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [](const Run& run) { return run.ok(); }));
}

std::string RunGroup::start_in_words() const {
  std::string words;
  for (const Ancestor& ancestor : runs.front().way)
    words += (words.empty() ? "" : ", from ") + ancestor.label;
  return words;
}

std::vector<RunGroup> group_runs(std::span<const Run> runs) {
  std::vector<RunGroup> groups;
  std::map<std::string, std::size_t> index;
  std::map<std::string, int> groups_of_label;
  for (const Run& run : runs) {
    const auto [place, is_new] = index.emplace(common_content(run.planned), groups.size());
    if (is_new) {
      groups.push_back({run.planned.label, run.planned.label, {}});
      ++groups_of_label[run.planned.label];
    }
    groups[place->second].runs.push_back(run);
  }
  for (RunGroup& group : groups) {
    const std::string words = in_words(group.runs.front().planned.point);
    if (groups_of_label[group.label] > 1 && !words.empty())
      group.heading += " (" + words + ")";
  }
  return groups;
}

} // namespace tamp
