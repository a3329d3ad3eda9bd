// Normally distributed radii, cut to [r_min, r_max].
#pragma once

#include "engine/model/truncated_normal.h"

namespace tamp {

class NormalLaw {
public:
  /// mean and sd are those of the law before truncation.
  NormalLaw(double mean, double sd, double r_min, double r_max);

  [[nodiscard]] double cdf(double r) const { return normal_.cdf(z(r)); }
  [[nodiscard]] double quantile(double u) const { return mean_ + sd_ * normal_.quantile(u); }
  /// E[R^k; R <= r].
  [[nodiscard]] double partial_moment(int k, double r) const;
  [[nodiscard]] double smallest() const { return r_min_; }
  [[nodiscard]] double largest() const { return r_max_; }

private:
  [[nodiscard]] double z(double r) const { return (r - mean_) / sd_; }

  double mean_;
  double sd_;
  double r_min_;
  double r_max_;
  TruncatedNormal normal_; // law of z = (r - mean) / sd
};

} // namespace tamp
