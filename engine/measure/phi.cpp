// Packing fraction of the central sub-box, exact.
#include "engine/base/parallel.h"
#include "engine/measure/ball_in_box.h"
#include "engine/measure/metrics.h"
#include "engine/measure/sub_box.h"

#include <cmath>

namespace tamp {

namespace {

/// What the sphere and its images along the periodic axes from `axis` on have in common with the box.
template <int D>
double with_images(const Packing& packing, Vec<D> centre, double radius, const SubBox<D>& box, int axis = 0) {
  if (axis == D)
    return ball_in_box<D>(centre, radius, box.low, box.high);
  const auto a = static_cast<std::size_t>(axis);
  if (packing.boundary[a] != Boundary::periodic)
    return with_images<D>(packing, centre, radius, box, axis + 1);
  const double period = packing.size[a];
  const double x = centre[axis];
  const double last = std::floor((box.high[axis] + radius - x) / period);
  double sum = 0;
  for (double k = std::ceil((box.low[axis] - radius - x) / period); k <= last; ++k) {
    centre[axis] = x + k * period;
    sum += with_images<D>(packing, centre, radius, box, axis + 1);
  }
  return sum;
}

template <int D>
double phi(const Metric& metric, const Packing& packing) {
  const SubBox<D> box = sub_box<D>(packing, metric.inset);
  const double filled = parallel_sum<double>(packing.count(), [&](std::size_t i) {
    return with_images<D>(packing, packing.centre<D>(i), packing.radii[i], box);
  });
  return filled / box.measure();
}

} // namespace

std::vector<Measure> measure_phi(const Metric& metric, const Packing& packing, const Scene&) {
  return with_dimension(packing.dimension, [&](auto d) -> std::vector<Measure> {
    return {{"phi", phi<d>(metric, packing), "1"}};
  });
}

} // namespace tamp
