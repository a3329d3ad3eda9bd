// Fits against lines known in closed form, a published regression, and points that are no power law.
#include "engine/base/error.h"
#include "engine/base/random.h"
#include "report/power_law.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tamp;

namespace {

std::vector<PowerPoint> exact(double a, double beta, const std::vector<double>& n) {
  std::vector<PowerPoint> points;
  for (const double x : n)
    points.push_back({x, a * std::pow(x, beta)});
  return points;
}

bool warns(const PowerLaw& law, const std::string& words) {
  return std::any_of(law.warnings.begin(), law.warnings.end(),
                     [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

} // namespace

TEST_CASE("An exact power law is found, with no spread and no warning") {
  const PowerLaw law = fit_power_law(exact(3e-6, 1.25, {1e3, 1e4, 1e5, 1e6, 3e6}));
  CHECK(law.beta == Approx(1.25).epsilon(1e-12));
  CHECK(law.a == Approx(3e-6).epsilon(1e-10));
  CHECK(law.r_squared == Approx(1));
  CHECK(law.beta_high - law.beta_low < 1e-10);
  CHECK(law.time(1e5) == Approx(3e-6 * std::pow(1e5, 1.25)));
  CHECK_FALSE(warns(law, "few"));
  CHECK_FALSE(warns(law, "narrow"));
}

TEST_CASE("Slope, standard error and interval are those of simple regression") {
  // ln N = 0, 1, 2, 3 and ln t = 0, 1, 1, 3: slope 0.9, residual sum of squares 0.7, standard error sqrt(0.35/5).
  std::vector<PowerPoint> points;
  const std::vector<double> logs = {0, 1, 1, 3};
  for (std::size_t i = 0; i < 4; ++i)
    points.push_back({std::exp(static_cast<double>(i)), std::exp(logs[i])});
  const PowerLaw law = fit_power_law(points);
  CHECK(law.beta == Approx(0.9));
  CHECK(std::log(law.a) == Approx(-0.1));
  CHECK(law.standard_error == Approx(std::sqrt(0.35 / 5)));
  const double t = 4.302652729911275; // quantile 0.975 of Student's t with 2 degrees of freedom
  CHECK(law.beta_low == Approx(0.9 - t * std::sqrt(0.07)));
  CHECK(law.beta_high == Approx(0.9 + t * std::sqrt(0.07)));
  CHECK(law.r_squared == Approx(1 - 0.7 / 4.75));
  REQUIRE(law.residuals.size() == 4);
  CHECK(law.residuals[2] == Approx(-0.7));
  // A parabola through these leaves 0.45 with one degree of freedom: t² = 0.25/0.45, Cauchy distributed.
  CHECK(law.curvature_p == Approx(1 - 2 / 3.141592653589793 * std::atan(std::sqrt(0.25 / 0.45))));
}

TEST_CASE("Units of time and scale of N change neither exponent nor interval") {
  RandomStream draw("power law units", 0);
  std::vector<PowerPoint> points = exact(1, 1.1, {1e3, 1e4, 1e5, 1e6});
  for (PowerPoint& point : points)
    point.t *= std::exp(0.1 * (draw.uniform() - 0.5));
  const PowerLaw seconds = fit_power_law(points);
  for (PowerPoint& point : points) {
    point.t *= 1e6;
    point.n *= 1e-3;
  }
  const PowerLaw other = fit_power_law(points);
  CHECK(other.beta == Approx(seconds.beta).epsilon(1e-10));
  CHECK(other.beta_low == Approx(seconds.beta_low).epsilon(1e-9));
  CHECK(other.curvature_p == Approx(seconds.curvature_p).epsilon(1e-6));
}

TEST_CASE("The interval holds the true exponent about 95 times in 100, and curvature is seen by chance 5 times") {
  int inside = 0;
  int curved = 0;
  const int trials = 2000;
  for (int i = 0; i < trials; ++i) {
    RandomStream draw("power law coverage", static_cast<std::uint64_t>(i));
    std::vector<PowerPoint> points = exact(1e-5, 1.05, {1e3, 3e3, 1e4, 3e4, 1e5, 3e5});
    for (PowerPoint& point : points) { // nearly normal errors: sums of twelve uniform ones
      double error = -6;
      for (int k = 0; k < 12; ++k)
        error += draw.uniform();
      point.t *= std::exp(0.1 * error);
    }
    const PowerLaw law = fit_power_law(points);
    inside += law.beta_low <= 1.05 && 1.05 <= law.beta_high ? 1 : 0;
    curved += law.curvature_p < kSignificance ? 1 : 0;
  }
  CHECK(inside / double(trials) == Approx(0.95).margin(0.02));
  CHECK(curved / double(trials) == Approx(0.05).margin(0.02));
}

TEST_CASE("Points that do not support a power law are said not to") {
  CHECK(warns(fit_power_law(exact(1, 1, {1e3, 1e4, 1e5})), "too few points (3"));
  CHECK(warns(fit_power_law(exact(1, 1, {1e3, 2e3, 3e3, 4e3})), "narrow range"));
  std::vector<PowerPoint> bent;
  for (const double n : {1e3, 1e4, 1e5, 1e6, 1e7})
    bent.push_back({n, 0.01 + 1e-6 * n * (1 + 0.01 * std::sin(n))});
  CHECK(warns(fit_power_law(bent), "curved residuals"));
  CHECK(warns(fit_power_law(bent), "rises"));
  CHECK(std::isnan(fit_power_law(exact(1, 1, {1e3, 1e3})).beta));
  CHECK(std::isnan(fit_power_law(exact(1, 1, {1e3, 1e4})).beta_low));
  CHECK(fit_power_law({}).points == 0);
  CHECK_THROWS_AS(fit_power_law(exact(-1, 1, {1e3, 1e4})), InputError);
}
