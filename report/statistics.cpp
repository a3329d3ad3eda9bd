// Two-pass mean and sample standard deviation; the median of an even number of values is the mean of the middle two.
#include "report/statistics.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp {

Summary summarize(std::span<const double> values) {
  Summary summary;
  summary.n = values.size();
  if (values.empty())
    return summary;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  summary.smallest = *low;
  summary.largest = *high;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t half = sorted.size() / 2;
  summary.median = sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
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

std::optional<Interval> median_interval(std::span<const double> values) {
  constexpr double outside = 0.05;
  if (values.size() < 2 || std::any_of(values.begin(), values.end(), [](double x) { return !(x > 0); }))
    return std::nullopt;
  std::vector<double> logarithms;
  for (const double x : values)
    logarithms.push_back(std::log(x));
  const Summary summary = summarize(logarithms);
  const auto n = static_cast<double>(values.size());
  const boost::math::students_t student(n - 1);
  const double reach = boost::math::quantile(boost::math::complement(student, outside / 2)) * summary.sd / std::sqrt(n);
  return Interval{std::exp(summary.mean - reach), std::exp(summary.mean + reach)};
}

} // namespace tamp
