// How many spheres of a bimodal packing are large, and how much of its volume they hold.
#include "engine/base/error.h"
#include "engine/measure/metrics.h"

#include <fmt/format.h>

#include <cmath>

namespace tamp {

std::vector<Measure> measure_composition(const Metric& metric, const Packing& packing, const Scene& scene) {
  if (!info(metric.name).applies(scene.psd)) {
    throw NotApplicable(
        fmt::format("the composition is that of a bimodal law; the law of this scene is {}", name_of(scene.psd.law)));
  }
  if (packing.unit != scene.unit || packing.dimension != scene.dimension) {
    throw Error(fmt::format("the radii of a packing in {} ({}D) cannot be compared with a law in {} ({}D)",
                            name_of(packing.unit), packing.dimension, name_of(scene.unit), scene.dimension));
  }
  const double small = scene.psd.small_radius;
  const double large = small * scene.psd.size_ratio;
  double count = 0;
  double volume = 0; // in balls of radius R_L
  double total = 0;
  for (const double r : packing.radii) {
    const double share = std::pow(r / large, packing.dimension);
    total += share;
    if (std::abs(r - large) <= std::abs(r - small)) {
      ++count;
      volume += share;
    }
  }
  return {
      {"N_L", count, "1"}, {"X_L", volume / total, "1"}, {"P_NL", count / static_cast<double>(packing.count()), "1"}};
}

} // namespace tamp
