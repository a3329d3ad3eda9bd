// The points of a sweep: blocks multiplied out, values derived, what conditions leave out.
#pragma once

#include "campaigns/point.h"

#include <deque>
#include <optional>
#include <string_view>
#include <vector>

namespace tamp {

struct SweepPoints {
  std::vector<SweepPoint> points; ///< in the order of the file; each with at least one method
  std::deque<Step> derived;       ///< what the points refer to beside the file's own steps
};

/// All points of the file, the first axis of a block varying slowest, its included points last; without a sweep the
/// scene alone. Nothing if there are more than `most`. Adds mistakes for conditions that never hold and for
/// expressions without a value.
std::optional<SweepPoints> sweep_points(const CampaignFile& file, std::size_t most, Mistakes& mistakes);

/// The point's own statement of a path; null if it has none.
const Statement* find_statement(const SweepPoint& point, std::string_view path);

/// The row of a "method/…" path if this method has it, else null.
const Parameter<Method>* method_row(std::string_view path, const Method& method);

} // namespace tamp
