// The paper's condition (ii): each sphere, looked at alone, rests on its supports.
#include "engine/base/parallel.h"
#include "engine/measure/metrics.h"
#include "engine/measure/packing_search.h"
#include "engine/measure/support.h"

namespace tamp {

namespace {

/// The horizontal places of the supports of every sphere, sphere by sphere.
template <int D>
struct Supports {
  std::vector<std::size_t> start; // one more at the end
  std::vector<Vec<D - 1>> points;
};

template <int D>
Supports<D> supports_of(const Packing& packing, double contact_gap) {
  std::vector<std::size_t> owners;
  std::vector<Vec<D - 1>> points;
  const auto add = [&](std::size_t i, const Vec<D>& towards) {
    // A gap of contact_gap leaves the direction of a contact open by as much: level supports still support.
    if (towards[vertical<D>] <= contact_gap && !towards.isZero(0)) {
      owners.push_back(i);
      points.push_back(towards.template head<D - 1>());
    }
  };
  const auto search = search_of<D>(packing);
  search.for_each_pair(contact_gap, [&](const SpherePair<D>& pair) {
    add(pair.i, pair.normal);
    add(pair.j, -pair.normal);
  });
  search.for_each_wall(contact_gap, [&](const WallContact& wall) {
    add(wall.i, Vec<D>::Unit(wall.axis) * (wall.side == 0 ? -1.0 : 1.0));
  });

  Supports<D> supports{std::vector<std::size_t>(packing.count() + 1, 0), std::vector<Vec<D - 1>>(points.size())};
  for (const std::size_t i : owners)
    ++supports.start[i + 1];
  for (std::size_t i = 0; i < packing.count(); ++i)
    supports.start[i + 1] += supports.start[i];
  std::vector<std::size_t> next(supports.start.begin(), supports.start.end() - 1);
  for (std::size_t p = 0; p < points.size(); ++p)
    supports.points[next[owners[p]]++] = points[p];
  return supports;
}

template <int D>
std::vector<Measure> stable_alone(const Packing& packing, double contact_gap) {
  const Supports<D> supports = supports_of<D>(packing, contact_gap);
  const std::span<const Vec<D - 1>> points(supports.points);
  const auto unstable = parallel_sum<std::size_t>(packing.count(), [&](std::size_t i) -> std::size_t {
    const std::size_t first = supports.start[i];
    return rests_on<D>(points.subspan(first, supports.start[i + 1] - first), contact_gap) ? 0 : 1;
  });
  const auto count = static_cast<double>(packing.count());
  return {{"stable_alone", (count - static_cast<double>(unstable)) / count, "1"},
          {"unstable_count", static_cast<double>(unstable), "1"}};
}

} // namespace

std::vector<Measure> measure_stable_alone(const Metric& metric, const Packing& packing, const Scene&) {
  return with_dimension(packing.dimension, [&](auto d) { return stable_alone<d>(packing, metric.contact_gap); });
}

} // namespace tamp
