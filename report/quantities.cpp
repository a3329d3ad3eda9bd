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

std::vector<std::string> ok_keys(const RunGroup& group) {
  std::vector<std::string> keys;
  for (const Run& run : group.runs) {
    if (run.ok())
      keys.push_back(run.planned.key);
  }
  return keys;
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
    cell.spread = summary.sd;
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

GroupTime group_time(const RunGroup& group) {
  const bool any_exclusive = std::any_of(group.runs.begin(), group.runs.end(), [](const Run& run) {
    return run.ok() && run.generation->timing.mode == TimingMode::exclusive;
  });
  const TimingMode mode = any_exclusive ? TimingMode::exclusive : TimingMode::shared;
  std::vector<double> seconds;
  GroupTime time;
  time.mode = mode;
  for (const Run& run : group.runs) {
    if (!run.ok() || run.generation->timing.mode != mode)
      continue;
    seconds.push_back(run.generation->timing.wall_s);
    time.keys.push_back(run.planned.key);
  }
  time.seconds = summarize(seconds);
  return time;
}

} // namespace tamp
