// Orders of convergence: known powers found with their intervals, and none where the points show none.
#include "engine/base/error.h"
#include "report/convergence_order.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

using tamp::convergence_order;
using tamp::ConvergenceOrder;
using tamp::OrderPoint;

namespace {

/// limit + factor step^order at steps 1, 1/2, 1/4 …, times `unit`.
std::vector<OrderPoint> power(double limit, double factor, double order, double error, std::size_t levels,
                              double unit = 1) {
  std::vector<OrderPoint> points;
  double step = 1;
  for (std::size_t i = 0; i < levels; ++i, step /= 2)
    points.push_back({unit * step, limit + factor * std::pow(step, order), error});
  return points;
}

} // namespace

TEST_CASE("a power of the step is found exactly, whatever the unit of the step", "[report]") {
  for (const double order : {0.5, 1.0, 2.0}) {
    for (const double unit : {1e-9, 1.0, 1e6}) {
      const ConvergenceOrder found = convergence_order(power(0.64, -0.1, order, 1e-4, 6, unit));
      INFO(order << " in units of " << unit);
      REQUIRE(found.found());
      CHECK(found.order == Approx(order).margin(0.011));
      CHECK(found.limit == Approx(0.64).margin(1e-4));
      CHECK(found.factor * std::pow(unit, order) == Approx(-0.1).epsilon(0.02));
      CHECK(found.order_low < order);
      CHECK(found.order_high > order);
    }
  }
}

TEST_CASE("the intervals of order and limit hold the truth about as often as they say", "[report]") {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  constexpr double kOrder = 1;
  constexpr double kError = 1e-3;
  int told = 0;
  int order_held = 0;
  int limit_held = 0;
  for (int i = 0; i < 300; ++i) {
    auto points = power(0.6, 0.1, kOrder, kError, 6);
    for (OrderPoint& point : points)
      point.value += kError * normal(random);
    const ConvergenceOrder found = convergence_order(points);
    if (!found.found())
      continue;
    ++told;
    order_held += found.order_low <= kOrder && kOrder <= found.order_high ? 1 : 0;
    limit_held += std::abs(found.limit - 0.6) <= 1.96 * found.limit_error ? 1 : 0;
  }
  REQUIRE(told > 250);
  CHECK(order_held > 0.90 * told);
  CHECK(limit_held > 0.90 * told);
}

TEST_CASE("no order is told where the points do not show one", "[report]") {
  CHECK(convergence_order(power(0.6, 0.1, 1, 1e-4, 3)).why_none == "too few levels");
  CHECK(convergence_order(power(0.6, 0.0, 1, 1e-4, 6)).why_none == "no change beyond the scatter");
  CHECK(convergence_order(power(0.6, 1e-4, 1, 1e-3, 6)).why_none == "no change beyond the scatter");
  auto bumpy = power(0.6, 0.1, 1, 1e-5, 6);
  bumpy[3].value += 0.05;
  CHECK(convergence_order(bumpy).why_none == "no power of the step fits");
  // A step between two plateaus: any high order will do.
  const std::vector<OrderPoint> jump = {{8, 1, 0.01}, {4, 0, 0.01}, {2, 0, 0.01}, {1, 0, 0.01}};
  CHECK_FALSE(convergence_order(jump).found());
  CHECK_FALSE(std::isfinite(convergence_order(jump).limit));
}

TEST_CASE("steps and errors must be above 0", "[report]") {
  auto points = power(0.6, 0.1, 1, 1e-4, 6);
  points[2].step = 0;
  CHECK_THROWS_AS(convergence_order(points), tamp::InputError);
  points = power(0.6, 0.1, 1, 1e-4, 6);
  points[2].standard_error = 0;
  CHECK_THROWS_AS(convergence_order(points), tamp::InputError);
}
