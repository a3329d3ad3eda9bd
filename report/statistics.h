// Statistics over replicates: mean, sample standard deviation, extremes.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace tamp {

/// Of n numbers; NaN where n is too small to say (below 1, for the standard deviation below 2).
struct Summary {
  std::size_t n = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double sd = std::numeric_limits<double>::quiet_NaN(); ///< sample standard deviation: divided by n - 1
  double smallest = std::numeric_limits<double>::quiet_NaN();
  double largest = std::numeric_limits<double>::quiet_NaN();
};

Summary summarize(std::span<const double> values);

} // namespace tamp
