// The factor is the worst contact's.
#include "engine/generate/harden.h"

#include "engine/search/packing_search.h"

#include <algorithm>

namespace tamp {

namespace {

/// Positions are rounded anew when they are widened: this much more than the worst overlap needs.
constexpr double kRounding = 1e-14;

/// Smallest ratio of a distance to what it would be in touch, at most 1.
template <int D>
double nearest(const Packing& packing) {
  const ContactSearch<D> search = search_of<D>(packing);
  double ratio = 1;
  search.for_each_pair(0, [&](const SpherePair<D>& pair) {
    ratio = std::min(ratio, 1 + pair.gap / (packing.radii[pair.i] + packing.radii[pair.j]));
  });
  search.for_each_wall(0,
                       [&](const WallContact& wall) { ratio = std::min(ratio, 1 + wall.gap / packing.radii[wall.i]); });
  return ratio;
}

template <int D>
double deepest(const Packing& packing) {
  const ContactSearch<D> search = search_of<D>(packing);
  double overlap = 0;
  search.for_each_pair(0, [&](const SpherePair<D>& pair) {
    overlap = std::max(overlap, -pair.gap / std::min(packing.radii[pair.i], packing.radii[pair.j]));
  });
  search.for_each_wall(
      0, [&](const WallContact& wall) { overlap = std::max(overlap, -wall.gap / packing.radii[wall.i]); });
  return overlap;
}

} // namespace

double deepest_overlap(const Packing& packing) {
  return with_dimension(packing.dimension, [&](auto d) { return deepest<decltype(d)::value>(packing); });
}

double harden(Packing& packing) {
  const double ratio = with_dimension(packing.dimension, [&](auto d) { return nearest<decltype(d)::value>(packing); });
  if (ratio >= 1)
    return 1;
  const double wider = (1 + kRounding) / ratio;
  for (double& edge : packing.size)
    edge *= wider;
  for (double& x : packing.positions)
    x *= wider;
  return wider;
}

} // namespace tamp
