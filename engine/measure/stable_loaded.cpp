// Equilibrium of all spheres at once under their weight.
#include "engine/measure/load_network.h"
#include "engine/measure/metrics.h"
#include "engine/search/packing_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tamp {

namespace {

/// A sphere is balanced if the net force and moment on it are below this share of the largest force that acts on it,
/// its weight among them.
constexpr double kBalanced = 0.01;

/// Contacts times iterations that a measurement may take: some seconds. Packings of many millions of contacts are left
/// far from the optimum, which loaded_violation then tells.
constexpr double kMostWork = 2e8;

template <int D>
std::vector<LoadContact<D>> load_contacts(const Packing& packing, double contact_gap) {
  const auto search = search_of<D>(packing);
  std::vector<LoadContact<D>> contacts;
  search.for_each_pair(contact_gap, [&](const SpherePair<D>& pair) {
    if (pair.i != pair.j && !pair.normal.isZero()) // the push of a sphere on its own image cancels
      contacts.push_back({static_cast<std::uint32_t>(pair.i), static_cast<std::uint32_t>(pair.j), pair.normal});
  });
  search.for_each_wall(contact_gap, [&](const WallContact& wall) {
    contacts.push_back({static_cast<std::uint32_t>(wall.i), LoadContact<D>::kWall,
                        Vec<D>::Unit(wall.axis) * (wall.side == 0 ? -1.0 : 1.0)});
  });
  return contacts;
}

template <int D>
std::vector<Measure> stable_loaded(const Metric& metric, const Packing& packing) {
  const std::size_t n = packing.count();
  const double largest_radius = *std::max_element(packing.radii.begin(), packing.radii.end());
  std::vector<double> weights;
  double mean = 0;
  for (const double r : packing.radii) {
    weights.push_back(std::pow(r / largest_radius, D));
    mean += weights.back() / static_cast<double>(n);
  }
  const std::vector<LoadContact<D>> contacts = load_contacts<D>(packing, metric.contact_gap);
  const auto affordable = static_cast<std::int64_t>(kMostWork / static_cast<double>(contacts.size() + 1));
  const LoadNetwork<D> network =
      carry_load<D>(contacts, weights, metric.friction, {.steps = std::min(metric.iterations, affordable)});
  std::vector<double> scale; // of each sphere: the largest force on it
  for (const double weight : weights)
    scale.push_back(weight / mean);
  double force_max = 0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double force = network.forces[k].norm();
    force_max = std::max(force_max, force);
    scale[contacts[k].i] = std::max(scale[contacts[k].i], force);
    if (contacts[k].j != LoadContact<D>::kWall)
      scale[contacts[k].j] = std::max(scale[contacts[k].j], force);
  }
  double squares = 0;
  double worst = 0;
  std::size_t unbalanced = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double square = network.residual[i].squaredNorm() + network.moment[i].squaredNorm();
    squares += square;
    worst = std::max(worst, std::sqrt(square));
    unbalanced += std::sqrt(square) > kBalanced * scale[i] ? 1U : 0U;
  }
  return {{"loaded_residual", std::sqrt(squares / static_cast<double>(n)), "1"},
          {"loaded_residual_max", worst, "1"},
          {"unbalanced", static_cast<double>(unbalanced) / static_cast<double>(n), "1"},
          {"loaded_force_max", force_max, "1"},
          {"loaded_violation", network.violation, "1"}};
}

} // namespace

std::vector<Measure> measure_stable_loaded(const Metric& metric, const Packing& packing, const Scene&) {
  return with_dimension(packing.dimension, [&](auto d) { return stable_loaded<d>(metric, packing); });
}

} // namespace tamp
