// The figures of one group of replicates: which quantity comes from which measure, and how it becomes a cell.
#pragma once

#include "report/runs.h"
#include "report/statistics.h"
#include "report/table.h"

#include <optional>
#include <span>
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

/// The same of what a Hellinger distance ("H_N") has above its sampling floor, which falls with the number of spheres.
Summary summarize_excess(const RunGroup& group, const std::string& distance);

/// Whether any of the groups has the measure.
bool any_has(std::span<const RunGroup> groups, std::string_view measure);

/// Whether the method makes packings that are periodic on all sides, whatever the scene's sides: it presses them from
/// there, so that its box is not the scene's, either.
bool is_periodic_all_round(const Method& method);

/// The packing fraction of one run: of the whole box where it is periodic all round, else of the central sub-box.
std::optional<double> density_of(const Run& run);

/// The keys of the ok runs of a group.
std::vector<std::string> ok_keys(const RunGroup& group);

/// Standard error of a measure within one packing, as its metric tells it (NAME_se); NaN if it does not.
double inner_error(const RunGroup& group, std::string_view symbol);

/// The cell of a quantity; empty if no run has it. Its spread is the standard deviation over replicates, of a single
/// one its inner error.
Cell quantity_cell(const RunGroup& group, const Quantity& quantity);

/// Wall-clock time of the generators. Where a group has both timing modes, only the exclusive runs count: a time taken
/// beside other jobs says little, and the two are never mixed.
struct GroupTime {
  Summary seconds;
  TimingMode mode = TimingMode::shared;
  std::optional<Interval> interval;  ///< of the median; see median_interval
  std::vector<std::string> keys;     ///< of the runs that count
  std::size_t disturbed = 0;         ///< of the mode, but left out, as something else was on the core meanwhile
  std::size_t samples = 0;           ///< of the runs that count and were timed several times each, all together
  std::size_t disturbed_samples = 0; ///< of these, left out in the same way
};
GroupTime group_time(const RunGroup& group);

/// The same with the times of the jobs whose packings the runs start from; what of them was not timed in that mode is
/// left out.
GroupTime way_time(const RunGroup& group);

} // namespace tamp
