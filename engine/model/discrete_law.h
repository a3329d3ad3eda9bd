// Spheres of one or two sizes.
#pragma once

#include <span>
#include <vector>

namespace tamp {

class DiscreteLaw {
public:
  /// All spheres alike.
  explicit DiscreteLaw(double radius) : radii_{radius}, shares_{1} {}
  /// Two sizes, small < large, a share of large_share by number being large; a share of 0 or 1 leaves one size.
  DiscreteLaw(double small, double large, double large_share);

  [[nodiscard]] double cdf(double r) const { return partial_moment(0, r); }
  [[nodiscard]] double quantile(double u) const { return u < shares_.front() ? radii_.front() : radii_.back(); }
  /// E[R^k; R <= r].
  [[nodiscard]] double partial_moment(int k, double r) const;
  [[nodiscard]] double smallest() const { return radii_.front(); }
  [[nodiscard]] double largest() const { return radii_.back(); }
  [[nodiscard]] std::span<const double> radii() const { return radii_; }
  [[nodiscard]] std::span<const double> shares() const { return shares_; }

private:
  std::vector<double> radii_;  // one or two, increasing
  std::vector<double> shares_; // by number
};

} // namespace tamp
