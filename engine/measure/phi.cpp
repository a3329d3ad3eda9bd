// Packing fraction of the central sub-box, exact.
#include "engine/base/parallel.h"
#include "engine/measure/ball_in_box.h"
#include "engine/measure/metrics.h"
#include "engine/measure/sub_box.h"

#include <array>
#include <cmath>
#include <cstddef>

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

/// Parts of the sub-box along each axis, whose densities give the standard error.
constexpr int kParts = 3;

/// Filled measure of each part.
template <int D>
struct Filled {
  std::array<double, D == 2 ? kParts * kParts : kParts * kParts * kParts> of_part{};

  void operator+=(const Filled& other) {
    for (std::size_t k = 0; k < of_part.size(); ++k)
      of_part[k] += other.of_part[k];
  }
};

template <int D>
double standard_error(const Packing& packing, const SubBox<D>& box) {
  const Vec<D> edge = (box.high - box.low) / kParts;
  const auto parts = parallel_sum<Filled<D>>(packing.count(), [&](std::size_t i) {
    Filled<D> filled;
    for (std::size_t k = 0; k < filled.of_part.size(); ++k) {
      SubBox<D> part;
      std::size_t rest = k;
      for (int a = 0; a < D; ++a, rest /= kParts)
        part.low[a] = box.low[a] + edge[a] * static_cast<double>(rest % kParts);
      part.high = part.low + edge;
      filled.of_part[k] = with_images<D>(packing, packing.centre<D>(i), packing.radii[i], part);
    }
    return filled;
  });
  const auto n = static_cast<double>(parts.of_part.size());
  double mean = 0;
  for (const double filled : parts.of_part)
    mean += filled / n;
  double squares = 0;
  for (const double filled : parts.of_part)
    squares += (filled - mean) * (filled - mean);
  return std::sqrt(squares / (n - 1) / n) / edge.prod();
}

template <int D>
double phi(const SubBox<D>& box, const Packing& packing) {
  const double filled = parallel_sum<double>(packing.count(), [&](std::size_t i) {
    return with_images<D>(packing, packing.centre<D>(i), packing.radii[i], box);
  });
  return filled / box.measure();
}

} // namespace

std::vector<Measure> measure_phi(const Metric& metric, const Packing& packing, const Scene&) {
  return with_dimension(packing.dimension, [&](auto d) -> std::vector<Measure> {
    const SubBox<d> box = sub_box<d>(packing, metric.inset);
    return {{"phi", phi<d>(box, packing), "1"}, {"phi_se", standard_error<d>(packing, box), "1"}};
  });
}

} // namespace tamp
