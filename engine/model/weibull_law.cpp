// Panel integration and inversion of the truncated Weibull law.
#include "engine/model/weibull_law.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tamp {

namespace {

// With ten nodes the rule is exact to rounding wherever the law holds mass: over a panel, t = exp(shape x) grows by a
// factor of at most exp(1/4), and the powers of r that volumes and moments bring in are as tame.
using Rule = boost::math::quadrature::gauss<double, 10>;
constexpr double kPanelWidth = 0.25;
constexpr double kLeastSteepness = 3;
// Bisection alone would end within as many steps as a double has bits.
constexpr int kMostSteps = 64;

} // namespace

WeibullLaw::WeibullLaw(double scale, double shape, int weight, double r_min, double r_max)
    : scale_(scale), shape_(shape), weight_(weight), r_min_(r_min), r_max_(r_max), x_min_(std::log(r_min / scale)),
      x_max_(std::log(r_max / scale)) {
  const double steepness = std::max(shape, kLeastSteepness);
  const auto panels = static_cast<std::size_t>(std::ceil((x_max_ - x_min_) * steepness / kPanelWidth));
  cumulative_.assign(std::max<std::size_t>(panels, 1) + 1, 0);
  for (std::size_t i = 0; i + 1 < cumulative_.size(); ++i) {
    cumulative_[i + 1] = cumulative_[i] + integral(panel_start(i), panel_start(i + 1), 0);
  }
}

double WeibullLaw::density(double x, int k) const {
  return std::exp((shape_ - weight_ + k) * x - std::exp(shape_ * x));
}

double WeibullLaw::integral(double x1, double x2, int k) const {
  return Rule::integrate([this, k](double x) { return density(x, k); }, x1, x2);
}

double WeibullLaw::panel_start(std::size_t panel) const {
  const double part = static_cast<double>(panel) / static_cast<double>(cumulative_.size() - 1);
  return x_min_ + (x_max_ - x_min_) * part;
}

std::size_t WeibullLaw::panel_of(double x) const {
  const std::size_t panels = cumulative_.size() - 1;
  const double part = std::clamp((x - x_min_) / (x_max_ - x_min_), 0.0, 1.0);
  return std::min(static_cast<std::size_t>(part * static_cast<double>(panels)), panels - 1);
}

double WeibullLaw::cdf(double r) const {
  const double x = std::log(r / scale_);
  const std::size_t panel = panel_of(x);
  return (cumulative_[panel] + integral(panel_start(panel), x, 0)) / cumulative_.back();
}

double WeibullLaw::quantile(double u) const {
  const double target = u * cumulative_.back();
  const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, target);
  const auto panel = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
  const double start = panel_start(panel);
  const double wanted = target - cumulative_[panel];

  double low = start;
  double high = panel_start(panel + 1);
  double x = low + (high - low) * std::min(wanted / (*above - cumulative_[panel]), 1.0);
  for (int step = 0; step < kMostSteps; ++step) {
    const double excess = integral(start, x, 0) - wanted;
    (excess > 0 ? high : low) = x;
    double next = x - excess / density(x, 0);
    if (!(next >= low && next <= high))
      next = (low + high) / 2;
    const bool done = std::abs(next - x) <= std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(x));
    x = next;
    if (done)
      break;
  }
  return scale_ * std::exp(x);
}

double WeibullLaw::partial_moment(int k, double r) const {
  const double x = std::log(r / scale_);
  const std::size_t panel = panel_of(x);
  double sum = 0;
  for (std::size_t i = 0; i < panel; ++i)
    sum += integral(panel_start(i), panel_start(i + 1), k);
  sum += integral(panel_start(panel), x, k);
  return std::pow(scale_, k) * sum / cumulative_.back();
}

} // namespace tamp
