// Statistics of measures and times over replicates, as cells.
#include "report/quantities.h"

#include <algorithm>
#include <vector>

namespace tamp {

Summary summarize_measure(const RunGroup& group, std::string_view measure) {
  std::vector<double> values;
  for (const Run& run : group.runs) {
    if (!run.ok())
      continue;
    if (const auto value = run.measure(measure))
      values.push_back(*value);
  }
  return summarize(values);
}

Summary summarize_excess(const RunGroup& group, const std::string& distance) {
  std::vector<double> values;
  for (const Run& run : group.runs) {
    const auto h = run.ok() ? run.measure(distance) : std::nullopt;
    const auto floor = run.measure(distance + "_floor");
    if (h && floor)
      values.push_back(*h - *floor);
  }
  return summarize(values);
}

bool any_has(std::span<const RunGroup> groups, std::string_view measure) {
  return std::any_of(groups.begin(), groups.end(),
                     [&](const RunGroup& group) { return summarize_measure(group, measure).n > 0; });
}

bool is_periodic_all_round(const Method& method) {
  return method.name == MethodName::dem_isostatic || method.name == MethodName::lammps_isostatic;
}

std::optional<double> density_of(const Run& run) {
  const auto whole = is_periodic_all_round(run.planned.job.method) ? run.measure("phi_box") : std::nullopt;
  return whole ? whole : run.measure("phi");
}

std::vector<std::string> ok_keys(const RunGroup& group) {
  std::vector<std::string> keys;
  for (const Run& run : group.runs) {
    if (run.ok())
      keys.push_back(run.planned.key);
  }
  return keys;
}

double inner_error(const RunGroup& group, std::string_view symbol) {
  return summarize_measure(group, std::string(symbol) + "_se").mean;
}

Cell quantity_cell(const RunGroup& group, const Quantity& quantity) {
  const Summary summary = summarize_measure(group, quantity.symbol == "N_part" ? "N" : quantity.symbol);
  Cell cell;
  cell.n = summary.n;
  cell.style = quantity.style;
  cell.decimals = quantity.decimals;
  cell.keys = ok_keys(group);
  switch (quantity.statistic) {
  case Statistic::mean:
    cell.value = summary.mean;
    cell.spread = summary.n == 1 ? inner_error(group, quantity.symbol) : summary.sd;
    break;
  case Statistic::largest:
    cell.value = summary.largest;
    break;
  case Statistic::smallest:
    cell.value = summary.smallest;
    break;
  }
  return cell;
}

GroupTime way_time(const RunGroup& group) {
  GroupTime time;
  time.mode = group_time(group).mode;
  std::vector<double> seconds;
  for (const Run& run : group.runs) {
    const auto sum = run.ok() ? run.way_seconds(time.mode) : std::nullopt;
    if (!sum)
      continue;
    seconds.push_back(*sum);
    time.keys.push_back(run.planned.key);
  }
  time.seconds = summarize(seconds);
  return time;
}

GroupTime group_time(const RunGroup& group) {
  const bool any_exclusive = std::any_of(group.runs.begin(), group.runs.end(), [](const Run& run) {
    return run.ok() && run.generation->timing.mode == TimingMode::exclusive;
  });
  const TimingMode mode = any_exclusive ? TimingMode::exclusive : TimingMode::shared;
  std::vector<double> seconds;
  GroupTime time;
  time.mode = mode;
  for (const Run& run : group.runs) {
    if (!run.ok())
      continue;
    if (!run.generation->timing.counts_as(mode)) {
      time.disturbed += run.generation->timing.mode == mode ? 1U : 0U;
      continue;
    }
    seconds.push_back(run.generation->timing.wall_s);
    time.keys.push_back(run.planned.key);
    for (const TimeSample& sample : run.generation->timing.samples) {
      ++time.samples;
      time.disturbed_samples += sample.disturbed.empty() ? 0U : 1U;
    }
  }
  time.seconds = summarize(seconds);
  time.interval = median_interval(seconds);
  return time;
}

} // namespace tamp
