// How far spheres reach into each other and through walls.
#include "engine/measure/metrics.h"
#include "engine/search/packing_search.h"

#include <algorithm>
#include <cstdint>

namespace tamp {

namespace {

template <int D>
std::vector<Measure> overlap(const Packing& packing) {
  double deepest = 0;
  std::uint64_t pairs = 0;
  std::uint64_t walls = 0;
  const auto count = [&](double depth, std::uint64_t& counter) {
    deepest = std::max(deepest, depth);
    counter += depth > kOverlapTolerance ? 1 : 0;
  };
  const auto search = search_of<D>(packing);
  search.for_each_pair(0, [&](const SpherePair<D>& pair) {
    count(-pair.gap / std::min(packing.radii[pair.i], packing.radii[pair.j]), pairs);
  });
  search.for_each_wall(0, [&](const WallContact& wall) { count(-wall.gap / packing.radii[wall.i], walls); });
  return {{"overlap_max", deepest, "1"},
          {"overlap_pairs", static_cast<double>(pairs), "1"},
          {"overlap_walls", static_cast<double>(walls), "1"}};
}

} // namespace

std::vector<Measure> measure_overlap(const Metric&, const Packing& packing, const Scene&) {
  return with_dimension(packing.dimension, [&](auto d) { return overlap<d>(packing); });
}

} // namespace tamp
