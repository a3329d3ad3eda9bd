// Power-law pieces of a measured size distribution.
#include "engine/model/histogram_law.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace tamp {

namespace {

/// Integral of (r/a)^power d(r/a) over [a, b]; by logarithms, so that narrow bins keep their digits.
double power_integral(double a, double b, int power) {
  const double x = std::log1p((b - a) / a);
  return power == -1 ? x : std::expm1((power + 1) * x) / (power + 1);
}

/// The b for which power_integral(a, b, power) has the given value.
double power_integral_inverse(double a, double value, int power) {
  return a * std::exp(power == -1 ? value : std::log1p(value * (power + 1)) / (power + 1));
}

} // namespace

HistogramLaw::HistogramLaw(std::span<const double> edges, std::span<const double> weights, int weight)
    : weight_(weight) {
  const auto filled = [](double w) { return w > 0; };
  const auto first = std::find_if(weights.begin(), weights.end(), filled) - weights.begin();
  const auto last = weights.rend() - std::find_if(weights.rbegin(), weights.rend(), filled);
  edges_.assign(edges.begin() + first, edges.begin() + last + 1);
  shares_.assign(weights.begin() + first, weights.begin() + last);
  const double smallest = edges_.front();
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const double a = edges_[i];
    const double b = edges_[i + 1];
    // From weight to number: the mean of r^-weight over the bin, in units of the smallest edge.
    shares_[i] *= std::pow(smallest / a, weight) * power_integral(a, b, -weight) / ((b - a) / a);
  }
  const double total = std::accumulate(shares_.begin(), shares_.end(), 0.0);
  for (double& share : shares_)
    share /= total;
  cumulative_.assign(edges_.size(), 0);
  std::partial_sum(shares_.begin(), shares_.end(), cumulative_.begin() + 1);
}

double HistogramLaw::cdf(double r) const {
  return partial_moment(0, r);
}

double HistogramLaw::quantile(double u) const {
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
  const auto bin = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
  const double part = std::clamp((u - cumulative_[bin]) / shares_[bin], 0.0, 1.0);
  const double a = edges_[bin];
  return power_integral_inverse(a, part * power_integral(a, edges_[bin + 1], -weight_), -weight_);
}

double HistogramLaw::partial_moment(int k, double r) const {
  double sum = 0;
  for (std::size_t i = 0; i < shares_.size() && edges_[i] < r; ++i) {
    const double a = edges_[i];
    const double b = edges_[i + 1];
    const double part = power_integral(a, std::min(b, r), k - weight_) / power_integral(a, b, -weight_);
    sum += shares_[i] * std::pow(a, k) * part;
  }
  return sum;
}

} // namespace tamp
