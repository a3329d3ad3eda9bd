// Least squares by QR decomposition; intervals and tests by Student's t.
#include "report/power_law.h"

#include "engine/base/error.h"

#include <Eigen/Dense>
#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

/// Coefficients of 1, x, x², …, their residuals, and the standard error of the last one.
struct Polynomial {
  Eigen::VectorXd coefficients;
  Eigen::VectorXd residuals;
  double last_error = PowerLaw::kNone; ///< NaN without a degree of freedom
  double freedom = 0;
};

Polynomial fit(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::Index degree) {
  Eigen::MatrixXd design(x.size(), degree + 1);
  for (Eigen::Index k = 0; k <= degree; ++k)
    design.col(k) = x.array().pow(static_cast<double>(k));
  Polynomial found;
  found.coefficients = design.colPivHouseholderQr().solve(y);
  found.residuals = y - design * found.coefficients;
  found.freedom = static_cast<double>(x.size() - degree - 1);
  if (found.freedom > 0) {
    const double variance = found.residuals.squaredNorm() / found.freedom;
    const Eigen::MatrixXd covariance = (design.transpose() * design).inverse() * variance;
    found.last_error = std::sqrt(covariance(degree, degree));
  }
  return found;
}

/// Two-sided p of a coefficient; 0 or 1 where the points lie exactly on the curve.
double two_sided(double coefficient, double error, double freedom) {
  if (!(error > 0))
    return coefficient == 0 ? 1 : 0;
  const boost::math::students_t student(freedom);
  return 2 * boost::math::cdf(boost::math::complement(student, std::abs(coefficient) / error));
}

std::size_t different(std::span<const PowerPoint> points) {
  std::vector<double> n;
  for (const PowerPoint& point : points)
    n.push_back(point.n);
  std::sort(n.begin(), n.end());
  return static_cast<std::size_t>(std::unique(n.begin(), n.end()) - n.begin());
}

void warn(PowerLaw& law, double bend) {
  if (law.points < kFewestPoints)
    law.warnings.push_back(fmt::format("too few points ({}; at least {})", law.points, kFewestPoints));
  if (law.points > 0 && !(law.n_high / law.n_low >= kNarrowRange))
    law.warnings.push_back(
        fmt::format("narrow range: N spans a factor of {:.2g}, less than {:g}", law.n_high / law.n_low, kNarrowRange));
  if (law.curvature_p < kSignificance) {
    law.warnings.push_back(
        fmt::format("curved residuals (p = {:.2g}): the local exponent {} from {:.2f} to {:.2f} over "
                    "the range",
                    law.curvature_p, bend > 0 ? "rises" : "falls", law.beta - bend, law.beta + bend));
  }
}

} // namespace

double PowerLaw::time(double n) const {
  return a * std::pow(n, beta);
}

PowerLaw fit_power_law(std::span<const PowerPoint> points) {
  PowerLaw law;
  law.points = points.size();
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::VectorXd x(count);
  Eigen::VectorXd y(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto [n, t] = points[static_cast<std::size_t>(i)];
    if (!(n > 0 && t > 0 && std::isfinite(n) && std::isfinite(t)))
      throw InputError(fmt::format("a power law through N = {}, t = {}; allowed: numbers above 0", n, t));
    x[i] = std::log(n);
    y[i] = std::log(t);
  }
  for (const PowerPoint& point : points) {
    law.n_low = std::fmin(law.n_low, point.n);
    law.n_high = std::fmax(law.n_high, point.n);
  }
  const std::size_t places = different(points);
  double bend = 0;
  if (places >= 2) {
    // Centred and scaled to [-1, 1]: then the columns are nearly orthogonal whatever the unit of N.
    const double centre = (x.maxCoeff() + x.minCoeff()) / 2;
    const double half = (x.maxCoeff() - x.minCoeff()) / 2;
    const Eigen::VectorXd u = (x.array() - centre) / half;
    const Polynomial line = fit(u, y, 1);
    law.beta = line.coefficients[1] / half;
    law.a = std::exp(line.coefficients[0] - law.beta * centre);
    law.residuals.assign(line.residuals.begin(), line.residuals.end());
    const double total = (y.array() - y.mean()).square().sum();
    law.r_squared = total > 0 ? 1 - line.residuals.squaredNorm() / total : 1;
    if (line.freedom > 0) {
      law.standard_error = line.last_error / half;
      const double reach =
          boost::math::quantile(boost::math::complement(boost::math::students_t(line.freedom), kSignificance / 2));
      law.beta_low = law.beta - reach * law.standard_error;
      law.beta_high = law.beta + reach * law.standard_error;
    }
    if (places >= 3 && count >= 4) {
      const Polynomial parabola = fit(u, y, 2);
      law.curvature_p = two_sided(parabola.coefficients[2], parabola.last_error, parabola.freedom);
      bend = 2 * parabola.coefficients[2] / half; // slope at an end minus slope in the middle
    }
  }
  warn(law, bend);
  return law;
}

} // namespace tamp
