// Bounding box of the centres, and its central part.
#include "engine/measure/sub_box.h"

#include "engine/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp {

template <int D>
Vec<D> wrapped_centre(const Packing& packing, std::size_t i) {
  Vec<D> x = packing.centre<D>(i);
  for (int a = 0; a < D; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    if (packing.boundary[axis] == Boundary::periodic)
      x[a] -= std::floor(x[a] / packing.size[axis]) * packing.size[axis];
  }
  return x;
}

template <int D>
SubBox<D> sub_box(const Packing& packing, double inset) {
  Vec<D> low = packing.centre<D>(0);
  Vec<D> high = low;
  const double largest = *std::max_element(packing.radii.begin(), packing.radii.end());
  for (std::size_t i = 1; i < packing.count(); ++i) {
    low = low.cwiseMin(packing.centre<D>(i));
    high = high.cwiseMax(packing.centre<D>(i));
  }
  for (int a = 0; a < D; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    if (packing.boundary[axis] == Boundary::periodic) {
      low[a] = 0;
      high[a] = packing.size[axis];
    }
    if (!(high[a] - low[a] > largest)) {
      throw NotApplicable(
          fmt::format("the density needs a box, but the {} sphere centres span only {:g} along axis {}, "
                      "less than the largest radius {:g}",
                      packing.count(), high[a] - low[a], a, largest));
    }
  }
  const Vec<D> cut = inset * (high - low);
  return {low + cut, high - cut};
}

template SubBox<2> sub_box<2>(const Packing&, double);
template SubBox<3> sub_box<3>(const Packing&, double);
template Vec<2> wrapped_centre<2>(const Packing&, std::size_t);
template Vec<3> wrapped_centre<3>(const Packing&, std::size_t);

} // namespace tamp
