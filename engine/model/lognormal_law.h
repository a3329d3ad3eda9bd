// Radii whose logarithm is normal, cut to [r_min, r_max].
#pragma once

#include "engine/model/truncated_normal.h"

namespace tamp {

/// Weighting a lognormal law by r^k gives a lognormal law of mean mu + k sigma^2: all moments are closed.
class LognormalLaw {
public:
  LognormalLaw(double mu_ln, double sigma_ln, double r_min, double r_max);

  [[nodiscard]] double cdf(double r) const { return normal_.cdf(z(r)); }
  [[nodiscard]] double quantile(double u) const;
  /// E[R^k; R <= r].
  [[nodiscard]] double partial_moment(int k, double r) const;
  [[nodiscard]] double smallest() const { return r_min_; }
  [[nodiscard]] double largest() const { return r_max_; }

private:
  [[nodiscard]] double z(double r) const;

  double mu_;
  double sigma_;
  double r_min_;
  double r_max_;
  TruncatedNormal normal_; // law of z = (ln r - mu) / sigma
};

} // namespace tamp
