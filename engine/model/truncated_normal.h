// The standard normal law cut to an interval, accurate in both tails.
#pragma once

namespace tamp {

/// Probability of a standard normal variable in [z1, z2]; no digits are lost when both lie far out on one side.
[[nodiscard]] double normal_share(double z1, double z2);

/// Standard normal density.
[[nodiscard]] double normal_density(double z);

/// The standard normal law on [z_min, z_max], renormalised.
class TruncatedNormal {
public:
  TruncatedNormal(double z_min, double z_max);

  [[nodiscard]] double cdf(double z) const;
  /// Inverse of cdf, for u in (0, 1); through erfc_inv of the nearer tail.
  [[nodiscard]] double quantile(double u) const;
  /// Probability of [z_min, z_max] before renormalising.
  [[nodiscard]] double mass() const { return mass_; }
  [[nodiscard]] double z_min() const { return z_min_; }

private:
  double z_min_;
  double z_max_;
  double below_; // tail under z_min
  double above_; // tail over z_max
  double mass_;
  double u_at_zero_; // cdf(0): which tail is the nearer one
};

} // namespace tamp
