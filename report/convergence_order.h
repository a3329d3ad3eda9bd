// Richardson's extrapolation: the order with which a quantity approaches its limit as a step size falls to 0.
#pragma once

#include <limits>
#include <span>
#include <string>

namespace tamp {

/// The quantity at one step size.
struct OrderPoint {
  double step;           ///< above 0
  double value;          ///< mean over replicates
  double standard_error; ///< of the mean, above 0
};

/// Fewer points than this leave no degree of freedom beside limit, factor and order.
inline constexpr std::size_t kFewestForOrder = 4;
/// Orders that are looked for; one at an end of the range is none.
inline constexpr double kLeastOrder = 0.1;
inline constexpr double kGreatestOrder = 4;

/// value = limit + factor * step^order by weighted least squares. Where the points do not show an order all numbers are
/// NaN and `why_none` says why.
struct ConvergenceOrder {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double limit = kNone;
  double limit_error = kNone; ///< standard error of the limit, with that of the order in it
  double factor = kNone;
  double order = kNone;
  double order_low = kNone; ///< 95 % interval of the order, from the profile of the sum of squares
  double order_high = kNone;
  std::string why_none;

  [[nodiscard]] bool found() const { return why_none.empty(); }
};

/// L. F. Richardson, Phil. Trans. R. Soc. A 210, 307 (1911), with the order fitted as P. J. Roache asks (Annu. Rev.
/// Fluid Mech. 29, 123 (1997)). Throws InputError if a step or an error is not above 0. There is no order if there are
/// too few points, the quantity does not change by more than its errors, or no order in the range, or every one, fits.
ConvergenceOrder convergence_order(std::span<const OrderPoint> points);

} // namespace tamp
