// Radii from measured size classes: uniform, by number or by volume, inside each bin.
#pragma once

#include <span>
#include <vector>

namespace tamp {

class HistogramLaw {
public:
  /// edges: K+1, increasing; weights: K shares, of any positive sum, of the sum of r^weight: weight 0 by number, the
  /// dimension by volume. Radii are uniform in that weighting inside a bin, so their number density falls as r^-weight.
  /// Empty bins at either end are dropped.
  HistogramLaw(std::span<const double> edges, std::span<const double> weights, int weight);

  [[nodiscard]] double cdf(double r) const;
  [[nodiscard]] double quantile(double u) const;
  /// E[R^k; R <= r].
  [[nodiscard]] double partial_moment(int k, double r) const;
  [[nodiscard]] double smallest() const { return edges_.front(); }
  [[nodiscard]] double largest() const { return edges_.back(); }

private:
  int weight_;
  std::vector<double> edges_;  // K + 1
  std::vector<double> shares_; // K: number share of each bin, kept beside the sums for the digits of rare coarse bins
  std::vector<double> cumulative_; // K + 1: number share below each edge
};

} // namespace tamp
