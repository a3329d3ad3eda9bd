// The power law t = a N^beta through measured points: least squares in logarithms, and whether the points support it.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace tamp {

/// One point; both numbers above 0.
struct PowerPoint {
  double n;
  double t;
};

/// Fewer points than this leave nothing to judge a line by.
inline constexpr std::size_t kFewestPoints = 4;
/// A narrower range of N (largest / smallest) says little about an exponent.
inline constexpr double kNarrowRange = 10;
/// Probability of an error of the first kind of the interval and of the test for curvature.
inline constexpr double kSignificance = 0.05;

/// ln t = ln a + beta ln N by ordinary least squares, all points alike. NaN where the points are too few to say.
struct PowerLaw {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::size_t points = 0;
  double n_low = kNone;
  double n_high = kNone;
  double a = kNone;
  double beta = kNone;
  double standard_error = kNone; ///< of beta; 3 points or more
  double beta_low = kNone;       ///< 95 % confidence interval of beta, Student's t with points - 2 degrees of freedom
  double beta_high = kNone;
  double r_squared = kNone;      ///< of ln t
  double curvature_p = kNone;    ///< two-sided p of a term in (ln N)^2, Student's t with points - 3 degrees of freedom
  std::vector<double> residuals; ///< ln t minus the line, in the order of the points
  std::vector<std::string> warnings; ///< why the points do not support a power law; empty if nothing speaks against it

  [[nodiscard]] double time(double n) const;
};

/// Throws InputError if a number is not above 0. Points at fewer than two different N give no line.
PowerLaw fit_power_law(std::span<const PowerPoint> points);

} // namespace tamp
