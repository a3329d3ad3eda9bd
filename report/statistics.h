// Statistics over replicates: mean, sample standard deviation, median with its interval, extremes.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace tamp {

/// Of n numbers; NaN where n is too small to say (below 1, for the standard deviation below 2).
struct Summary {
  std::size_t n = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double sd = std::numeric_limits<double>::quiet_NaN(); ///< sample standard deviation: divided by n - 1
  double median = std::numeric_limits<double>::quiet_NaN();
  double smallest = std::numeric_limits<double>::quiet_NaN();
  double largest = std::numeric_limits<double>::quiet_NaN();
};

Summary summarize(std::span<const double> values);

struct Interval {
  double low = 0;
  double high = 0;
};

/// The 95 % confidence interval of the median of positive numbers, as times are, whose logarithms scatter normally: of
/// these Student's interval of the mean. Nothing for fewer than two numbers, or if one is not above 0.
std::optional<Interval> median_interval(std::span<const double> values);

} // namespace tamp
