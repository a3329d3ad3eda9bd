// Moments of the logarithms, and the distance of the cumulated distributions.
#include "engine/model/lognormal_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp {

namespace {

constexpr double kSigmas95 = 1.959963984540054; // of a normal law, to either side, that hold 95 %
constexpr double kLilliefors95 = 0.886;
constexpr double kEqual = 1e-9; // radii that differ less, relative to each other, count as equal

} // namespace

LognormalFit fit_lognormal(std::span<const double> radii) {
  const auto n = static_cast<double>(radii.size());
  std::vector<double> logs(radii.size());
  std::transform(radii.begin(), radii.end(), logs.begin(), [](double r) { return std::log(r); });
  std::sort(logs.begin(), logs.end());
  LognormalFit fit;
  for (const double x : logs)
    fit.mu_ln += x / n;
  double squares = 0;
  for (const double x : logs)
    squares += (x - fit.mu_ln) * (x - fit.mu_ln);
  if (logs.back() - logs.front() <= kEqual)
    return fit;
  fit.sigma_ln = std::sqrt(squares / (n - 1));
  fit.mu_ln_error = kSigmas95 * fit.sigma_ln / std::sqrt(n);
  fit.sigma_ln_error = fit.mu_ln_error / std::sqrt(2.0);
  fit.limit = kLilliefors95 / std::sqrt(n);
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const double p = 0.5 * std::erfc((fit.mu_ln - logs[i]) / (fit.sigma_ln * std::sqrt(2.0)));
    const auto below = static_cast<double>(i);
    fit.distance = std::max({fit.distance, p - below / n, (below + 1) / n - p});
  }
  return fit;
}

Psd law_of_fit(const LognormalFit& fit, std::span<const double> radii) {
  Psd psd;
  if (fit.sigma_ln == 0) {
    psd.law = Law::monodisperse;
    psd.radius = radii.front();
    return psd;
  }
  const auto [smallest, largest] = std::minmax_element(radii.begin(), radii.end());
  psd.law = Law::lognormal;
  psd.mu_ln = fit.mu_ln;
  psd.sigma_ln = fit.sigma_ln;
  psd.r_min = *smallest;
  psd.r_max = *largest;
  return psd;
}

} // namespace tamp
