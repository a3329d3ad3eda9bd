// Condition (ii) of the benchmark: each sphere, looked at alone with its neighbours held, is in equilibrium.
#include "engine/base/parallel.h"
#include "engine/measure/metrics.h"
#include "engine/measure/support.h"
#include "engine/search/packing_search.h"

namespace tamp {

namespace {

/// The contact normals of every sphere, into it, sphere by sphere.
template <int D>
struct Contacts {
  std::vector<std::size_t> start; // one more at the end
  std::vector<Vec<D>> normals;
};

template <int D>
Contacts<D> contacts_of(const Packing& packing, double contact_gap) {
  std::vector<std::size_t> owners;
  std::vector<Vec<D>> normals;
  const auto add = [&](std::size_t i, const Vec<D>& normal) {
    owners.push_back(i);
    normals.push_back(normal);
  };
  const auto search = search_of<D>(packing);
  search.for_each_pair(contact_gap, [&](const SpherePair<D>& pair) {
    add(pair.i, -pair.normal);
    add(pair.j, pair.normal);
  });
  search.for_each_wall(contact_gap, [&](const WallContact& wall) {
    add(wall.i, Vec<D>::Unit(wall.axis) * (wall.side == 0 ? 1.0 : -1.0));
  });

  Contacts<D> contacts{std::vector<std::size_t>(packing.count() + 1, 0), std::vector<Vec<D>>(normals.size())};
  for (const std::size_t i : owners)
    ++contacts.start[i + 1];
  for (std::size_t i = 0; i < packing.count(); ++i)
    contacts.start[i + 1] += contacts.start[i];
  std::vector<std::size_t> next(contacts.start.begin(), contacts.start.end() - 1);
  for (std::size_t c = 0; c < normals.size(); ++c)
    contacts.normals[next[owners[c]]++] = normals[c];
  return contacts;
}

/// A sphere counts as stable when the descent its contacts leave free is at most contact_gap: a gap of that share of
/// the radius leaves the direction of a contact open by as much.
template <int D>
std::vector<Measure> stable_alone(const Packing& packing, double contact_gap) {
  const Contacts<D> contacts = contacts_of<D>(packing, contact_gap);
  const std::span<const Vec<D>> normals(contacts.normals);
  const auto unstable = parallel_sum<std::size_t>(packing.count(), [&](std::size_t i) -> std::size_t {
    const std::size_t first = contacts.start[i];
    return free_descent<D>(normals.subspan(first, contacts.start[i + 1] - first)) <= contact_gap ? 0 : 1;
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
