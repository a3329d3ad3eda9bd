// The number law of radii behind a stated size distribution: probabilities, quantiles and moments.
#pragma once

#include "engine/model/discrete_law.h"
#include "engine/model/histogram_law.h"
#include "engine/model/lognormal_law.h"
#include "engine/model/normal_law.h"
#include "engine/model/psd.h"
#include "engine/model/weibull_law.h"

#include <span>
#include <variant>

namespace tamp {

/// Number-weighted law of radii, truncated to [r_min, r_max] and renormalised; lengths in the unit of the Psd.
/// Immutable.
class SizeLaw {
public:
  /// dimension (2 or 3) is the power of r that volume weights and volume fractions mean. Throws InputError where
  /// check() or contradiction() object.
  SizeLaw(const Psd& psd, int dimension);

  /// Share of spheres of radius <= r.
  [[nodiscard]] double cdf(double r) const;
  /// The radius that a share u of the spheres does not exceed; u <= 0 gives smallest(), u >= 1 largest(). Inverts cdf
  /// to 1e-12 relative or to the rounding of u, whichever is coarser (a double near 1 resolves the upper tail to
  /// 1e-16).
  [[nodiscard]] double quantile(double u) const;
  /// E[R^k], k >= 0.
  [[nodiscard]] double moment(int k) const;
  /// Share of the sum of r^k held by spheres of radius <= r: k = 0 by number, 2 by surface, 3 by volume.
  [[nodiscard]] double weighted_cdf(double r, int k) const;

  [[nodiscard]] double smallest() const;
  [[nodiscard]] double largest() const;

  /// Radii of a discrete law (one or two), increasing, and their number shares; empty for continuous laws.
  [[nodiscard]] std::span<const double> classes() const;
  [[nodiscard]] std::span<const double> class_shares() const;

private:
  std::variant<DiscreteLaw, LognormalLaw, NormalLaw, WeibullLaw, HistogramLaw> law_;
};

} // namespace tamp
