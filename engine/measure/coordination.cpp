// Mean number of contacts, with all spheres and without those that carry nothing.
#include "engine/measure/metrics.h"
#include "engine/search/packing_search.h"

#include <cmath>
#include <cstdint>

namespace tamp {

namespace {

/// Contacts between spheres as lists of partners, and how many walls each sphere touches.
struct ContactGraph {
  std::vector<std::size_t> start; // of each sphere's partners; one more at the end
  std::vector<std::uint32_t> partners;
  std::vector<std::uint32_t> walls;
};

template <int D>
ContactGraph contact_graph(const Packing& packing, double contact_gap) {
  const std::size_t n = packing.count();
  const auto search = search_of<D>(packing);
  std::vector<std::array<std::uint32_t, 2>> pairs;
  search.for_each_pair(contact_gap, [&](const SpherePair<D>& pair) {
    pairs.push_back({static_cast<std::uint32_t>(pair.i), static_cast<std::uint32_t>(pair.j)});
  });
  ContactGraph graph;
  graph.start.resize(n + 1);
  graph.walls.resize(n);
  search.for_each_wall(contact_gap, [&](const WallContact& wall) { ++graph.walls[wall.i]; });
  for (const auto& [i, j] : pairs) {
    ++graph.start[i + 1];
    ++graph.start[j + 1];
  }
  for (std::size_t i = 0; i < n; ++i)
    graph.start[i + 1] += graph.start[i];
  graph.partners.resize(2 * pairs.size());
  std::vector<std::size_t> next(graph.start.begin(), graph.start.end() - 1);
  for (const auto& [i, j] : pairs) {
    graph.partners[next[i]++] = j;
    graph.partners[next[j]++] = i;
  }
  return graph;
}

template <int D>
std::vector<Measure> coordination(const Packing& packing, double contact_gap) {
  const std::size_t n = packing.count();
  const ContactGraph graph = contact_graph<D>(packing, contact_gap);
  std::vector<std::size_t> contacts(n); // left of each sphere, walls included
  std::vector<bool> rattler(n, false);
  std::vector<std::size_t> to_remove;
  const auto look_at = [&](std::size_t i) {
    if (!rattler[i] && contacts[i] < D + 1) {
      rattler[i] = true;
      to_remove.push_back(i);
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    contacts[i] = graph.start[i + 1] - graph.start[i] + graph.walls[i];
    look_at(i);
  }
  double squares = 0; // of each sphere's number of partners from the mean one
  const double mean = n == 0 ? 0 : static_cast<double>(graph.partners.size()) / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double off = static_cast<double>(graph.start[i + 1] - graph.start[i]) - mean;
    squares += off * off;
  }
  std::size_t rattlers = 0;
  while (!to_remove.empty()) {
    const std::size_t i = to_remove.back();
    to_remove.pop_back();
    ++rattlers;
    for (std::size_t p = graph.start[i]; p < graph.start[i + 1]; ++p) {
      const std::size_t j = graph.partners[p];
      --contacts[j];
      look_at(j);
    }
  }
  std::size_t ends = 0; // of contacts between the spheres that are left
  for (std::size_t i = 0; i < n; ++i)
    ends += rattler[i] ? 0 : contacts[i] - graph.walls[i];
  const auto of = [](std::size_t part, std::size_t whole) {
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
  };
  const auto count = static_cast<double>(n);
  return {{"z", of(graph.partners.size(), n), "1"},
          {"z_se", n < 2 ? 0 : std::sqrt(squares / (count - 1) / count), "1"},
          {"z_no_rattlers", of(ends, n - rattlers), "1"},
          {"rattlers", of(rattlers, n), "1"}};
}

} // namespace

std::vector<Measure> measure_coordination(const Metric& metric, const Packing& packing, const Scene&) {
  return with_dimension(packing.dimension, [&](auto d) { return coordination<d>(packing, metric.contact_gap); });
}

} // namespace tamp
