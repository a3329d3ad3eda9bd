// Two-pass mean and sample standard deviation.
#include "report/statistics.h"

#include <algorithm>
#include <cmath>

namespace tamp {

Summary summarize(std::span<const double> values) {
  Summary summary;
  summary.n = values.size();
  if (values.empty())
    return summary;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  summary.smallest = *low;
  summary.largest = *high;
  // Deviations from the first value: equal values then have exactly that mean and a standard deviation of exactly 0.
  const double origin = values.front();
  const auto n = static_cast<double>(values.size());
  double sum = 0;
  for (const double x : values)
    sum += x - origin;
  const double offset = sum / n;
  summary.mean = origin + offset;
  if (values.size() < 2)
    return summary;
  double squares = 0;
  for (const double x : values)
    squares += (x - origin - offset) * (x - origin - offset);
  summary.sd = std::sqrt(squares / (n - 1));
  return summary;
}

} // namespace tamp
