// Radii of which a share exp(-(r/scale)^shape), by number or by volume, is coarser than r, cut to [r_min, r_max].
#pragma once

#include <cstddef>
#include <vector>

namespace tamp {

/// The number law of a Weibull statement weighted by r^weight: density r^(shape-1-weight) exp(-(r/scale)^shape). weight
/// is 0 for a statement by number, the dimension for one by volume (Rosin-Rammler). The distribution function and the
/// moments are incomplete gamma functions, of an order that is often negative and may be large. So they are integrated
/// by Gauss panels in x = ln(r/scale), where the integrand is analytic, and inverted inside a panel by a bracketed
/// Newton iteration.
class WeibullLaw {
public:
  WeibullLaw(double scale, double shape, int weight, double r_min, double r_max);

  [[nodiscard]] double cdf(double r) const;
  [[nodiscard]] double quantile(double u) const;
  /// E[R^k; R <= r].
  [[nodiscard]] double partial_moment(int k, double r) const;
  [[nodiscard]] double smallest() const { return r_min_; }
  [[nodiscard]] double largest() const { return r_max_; }

private:
  [[nodiscard]] double density(double x, int k) const;
  /// Integral of density(x, k) over a stretch no longer than a panel.
  [[nodiscard]] double integral(double x1, double x2, int k) const;
  [[nodiscard]] double panel_start(std::size_t panel) const;
  [[nodiscard]] std::size_t panel_of(double x) const;

  double scale_;
  double shape_;
  int weight_;
  double r_min_;
  double r_max_;
  double x_min_;
  double x_max_;
  std::vector<double> cumulative_; // unnormalised number of spheres below the start of each panel, and the total
};

} // namespace tamp
