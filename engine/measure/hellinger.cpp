// Hellinger distance of the radii of a packing to the law they should follow.
#include "engine/base/error.h"
#include "engine/measure/metrics.h"
#include "engine/measure/sampling_floor.h"
#include "engine/measure/size_bins.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tamp {

namespace {

/// A distance and its standard error.
struct Distance {
  double value;
  double standard_error;
};

/// Distance of the radii, each weighted by r^power, to the law in its bins. With B = 1 − H² = Σ √(p q), a sphere of
/// weight w in bin b moves B by w/(2 Σw) (√(q_b/p_b) − B), to first order; independent draws add the squares up. By
/// number that is the multinomial's var B = (Σ q − B²)/(4 n), the sum over bins with p > 0.
Distance distance(const Packing& packing, const SizeBins& bins, int power) {
  const double largest = *std::max_element(packing.radii.begin(), packing.radii.end());
  std::vector<double> found(bins.count(), 0);
  std::vector<double> squares(bins.count(), 0); // of the weights in each bin
  double outside = 0;
  double squares_outside = 0;
  double total = 0;
  for (const double r : packing.radii) {
    const double weight = std::pow(r / largest, power);
    const auto bin = bins.of(r);
    (bin ? found[*bin] : outside) += weight;
    (bin ? squares[*bin] : squares_outside) += weight * weight;
    total += weight;
  }
  for (double& share : found)
    share /= total;
  const auto expected = bins.shares(power);
  const double h = hellinger_distance(found, outside / total, expected);
  const double overlap = 1 - h * h;
  double variance = squares_outside * overlap * overlap;
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b] > 0)
      variance += squares[b] * std::pow(std::sqrt(expected[b] / found[b]) - overlap, 2);
  }
  return {h, h > 0 ? std::sqrt(variance) / (4 * total * h) : 0};
}

} // namespace

std::vector<Measure> measure_hellinger(const Metric& metric, const Packing& packing, const Scene& scene) {
  if (packing.unit != scene.unit || packing.dimension != scene.dimension) {
    throw Error(fmt::format("the radii of a packing in {} ({}D) cannot be compared with a law in {} ({}D)",
                            name_of(packing.unit), packing.dimension, name_of(scene.unit), scene.dimension));
  }
  const SizeLaw law(scene.psd, packing.dimension);
  const SizeBins bins(law, static_cast<std::size_t>(metric.bins));
  const int power = packing.dimension;
  const std::string weighted = power == 2 ? "H_S" : "H_V";
  const Distance by_number = distance(packing, bins, 0);
  const Distance by_volume = distance(packing, bins, power);
  return {{"H_N", by_number.value, "1"},
          {"H_N_se", by_number.standard_error, "1"},
          {weighted, by_volume.value, "1"},
          {weighted + "_se", by_volume.standard_error, "1"},
          {"H_N_floor", number_floor(bins.shares(0), packing.count()), "1"},
          {weighted + "_floor", weighted_floor(law, bins, power, packing.count()), "1"},
          {"bins", static_cast<double>(bins.count()), "1"}};
}

} // namespace tamp
