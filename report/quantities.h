// The figures of one group of replicates: which quantity comes from which measure, and how it becomes a cell.
#pragma once

#include "report/runs.h"
#include "report/statistics.h"
#include "report/table.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// What a table shows of the replicates: their mean, or the worst one.
enum class Statistic { mean, largest, smallest };

/// A column of a table. `symbol` is also the name of the measure, apart from N_part (measure N).
struct Quantity {
  std::string_view symbol;
  CellStyle style = CellStyle::fixed;
  int decimals = 4; ///< of a value without a spread
  Statistic statistic = Statistic::mean;
};

/// The statistics of a measure over the ok runs of the group that have it.
Summary summarize_measure(const RunGroup& group, std::string_view measure);

/// The keys of the ok runs of a group.
std::vector<std::string> ok_keys(const RunGroup& group);

/// The cell of a quantity; empty if no run has it.
Cell quantity_cell(const RunGroup& group, const Quantity& quantity);

/// Wall-clock time of the generators. Where a group has both timing modes, only the exclusive runs count: a time taken
/// beside other jobs says little, and the two are never mixed.
struct GroupTime {
  Summary seconds;
  TimingMode mode = TimingMode::shared;
  std::vector<std::string> keys; ///< of the runs that count
};
GroupTime group_time(const RunGroup& group);

} // namespace tamp
