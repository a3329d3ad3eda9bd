// Scans the order; for each, limit and factor follow from linear least squares.
#include "report/convergence_order.h"

#include "engine/base/error.h"

#include <Eigen/Dense>
#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp {

namespace {

constexpr double kConfidence = 0.95;
/// Between orders that are tried: finer than any interval that a handful of levels leaves.
constexpr double kOrderStep = 0.01;

struct Fit {
  double order;
  double limit;
  double limit_variance;
  double factor;
  double chi_squared;
};

Fit fit_at(std::span<const OrderPoint> points, double order) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd design(n, 2);
  Eigen::VectorXd values(n);
  // Steps relative to the largest, so that powers of them are of order one whatever their unit.
  const double largest = std::max_element(points.begin(), points.end(), [](const OrderPoint& a, const OrderPoint& b) {
                           return a.step < b.step;
                         })->step;
  for (Eigen::Index i = 0; i < n; ++i) {
    const OrderPoint& point = points[static_cast<std::size_t>(i)];
    design(i, 0) = 1 / point.standard_error;
    design(i, 1) = std::pow(point.step / largest, order) / point.standard_error;
    values(i) = point.value / point.standard_error;
  }
  const Eigen::Vector2d solution = design.colPivHouseholderQr().solve(values);
  const Eigen::Matrix2d covariance = (design.transpose() * design).inverse();
  return {order, solution(0), covariance(0, 0), solution(1) / std::pow(largest, order),
          (values - design * solution).squaredNorm()};
}

/// Sum of squares about the weighted mean: of a quantity that does not depend on the step.
double constant_chi_squared(std::span<const OrderPoint> points) {
  double weights = 0;
  double sum = 0;
  for (const OrderPoint& point : points) {
    const double weight = 1 / (point.standard_error * point.standard_error);
    weights += weight;
    sum += weight * point.value;
  }
  double total = 0;
  for (const OrderPoint& point : points)
    total += std::pow((point.value - sum / weights) / point.standard_error, 2);
  return total;
}

double chi_squared_quantile(double freedom, double probability) {
  return boost::math::quantile(boost::math::chi_squared(freedom), probability);
}

ConvergenceOrder none(std::string why) {
  ConvergenceOrder found;
  found.why_none = std::move(why);
  return found;
}

} // namespace

ConvergenceOrder convergence_order(std::span<const OrderPoint> points) {
  for (const OrderPoint& point : points) {
    if (!(point.step > 0) || !(point.standard_error > 0) || !std::isfinite(point.value))
      throw InputError("an order of convergence needs steps and standard errors above 0, and finite values");
  }
  if (points.size() < kFewestForOrder)
    return none("too few levels");
  const auto n = static_cast<double>(points.size());
  if (constant_chi_squared(points) < chi_squared_quantile(n - 1, kConfidence))
    return none("no change beyond the scatter");
  std::vector<Fit> fits;
  const int tries = static_cast<int>(std::lround((kGreatestOrder - kLeastOrder) / kOrderStep));
  for (int i = 0; i <= tries; ++i)
    fits.push_back(fit_at(points, kLeastOrder + i * kOrderStep));
  const Fit best = *std::min_element(fits.begin(), fits.end(),
                                     [](const Fit& a, const Fit& b) { return a.chi_squared < b.chi_squared; });
  if (best.chi_squared > chi_squared_quantile(n - 3, kConfidence))
    return none("no power of the step fits");
  // The profile: all orders whose sum of squares exceeds the least by no more than chance does.
  const double bound = best.chi_squared + chi_squared_quantile(1, kConfidence);
  // An interval is never told finer than the orders that were tried.
  ConvergenceOrder found{best.limit, 0, best.factor, best.order, best.order - kOrderStep, best.order + kOrderStep, {}};
  double furthest = 0;
  for (const Fit& fit : fits) {
    if (fit.chi_squared > bound)
      continue;
    found.order_low = std::min(found.order_low, fit.order);
    found.order_high = std::max(found.order_high, fit.order);
    furthest = std::max(furthest, std::abs(fit.limit - best.limit));
  }
  if (found.order_low <= kLeastOrder || found.order_high >= kGreatestOrder)
    return none("the levels do not tell the order");
  const double reach = std::sqrt(chi_squared_quantile(1, kConfidence)); // of the interval, in standard errors
  found.limit_error = std::hypot(std::sqrt(best.limit_variance), furthest / reach);
  return found;
}

} // namespace tamp
