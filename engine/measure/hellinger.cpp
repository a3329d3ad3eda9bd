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

/// Distance of the radii, each weighted by r^power, to the law in its bins.
double distance(const Packing& packing, const SizeBins& bins, int power) {
  const double largest = *std::max_element(packing.radii.begin(), packing.radii.end());
  std::vector<double> found(bins.count(), 0);
  double outside = 0;
  double total = 0;
  for (const double r : packing.radii) {
    const double weight = std::pow(r / largest, power);
    const auto bin = bins.of(r);
    (bin ? found[*bin] : outside) += weight;
    total += weight;
  }
  for (double& share : found)
    share /= total;
  return hellinger_distance(found, outside / total, bins.shares(power));
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
  return {{"H_N", distance(packing, bins, 0), "1"},
          {weighted, distance(packing, bins, power), "1"},
          {"H_N_floor", number_floor(bins.shares(0), packing.count()), "1"},
          {weighted + "_floor", weighted_floor(law, bins, power, packing.count()), "1"},
          {"bins", static_cast<double>(bins.count()), "1"}};
}

} // namespace tamp
