// Tests the difference of two means.
#include "report/t_test.h"

#include "report/statistics.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace tamp {

namespace {

/// A spread that is no more than what rounding leaves of equal numbers tells nothing.
constexpr double kRounding = 1e-14;

std::optional<MeanDifference> judged(double difference, double error, double freedom, double scale) {
  if (!(error > kRounding * scale))
    return std::nullopt;
  const double t = difference / error;
  const boost::math::students_t student(freedom);
  return MeanDifference{difference, error, freedom, t,
                        2 * boost::math::cdf(boost::math::complement(student, std::abs(t)))};
}

} // namespace

std::optional<MeanDifference> welch_test(std::span<const double> a, std::span<const double> b) {
  const Summary left = summarize(a);
  const Summary right = summarize(b);
  if (left.n < 2 || right.n < 2)
    return std::nullopt;
  const double u = left.sd * left.sd / static_cast<double>(left.n);
  const double v = right.sd * right.sd / static_cast<double>(right.n);
  const double freedom =
      (u + v) * (u + v) / (u * u / static_cast<double>(left.n - 1) + v * v / static_cast<double>(right.n - 1));
  return judged(right.mean - left.mean, std::sqrt(u + v), freedom, std::max(std::abs(left.mean), std::abs(right.mean)));
}

std::optional<MeanDifference> paired_test(std::span<const double> a, std::span<const double> b) {
  std::vector<double> differences;
  double scale = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences.push_back(b[i] - a[i]);
    scale = std::max({scale, std::abs(a[i]), std::abs(b[i])});
  }
  const Summary found = summarize(differences);
  if (found.n < 2)
    return std::nullopt;
  return judged(found.mean, found.sd / std::sqrt(static_cast<double>(found.n)), static_cast<double>(found.n - 1),
                scale);
}

std::vector<double> holm_adjusted(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return p[i] < p[j]; });
  std::vector<double> adjusted(p.size());
  double highest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    highest = std::max(highest, std::min(1.0, static_cast<double>(p.size() - rank) * p[order[rank]]));
    adjusted[order[rank]] = highest;
  }
  return adjusted;
}

} // namespace tamp
