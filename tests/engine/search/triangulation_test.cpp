// Edges of the power diagram's dual against its definition.
#include "engine/base/random.h"
#include "engine/base/vec.h"
#include "engine/search/triangulation.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

using namespace tamp;

namespace {

/// All edges by definition: D + 1 spheres form a simplex of the triangulation if no other sphere has a smaller power
/// than they have with respect to their common orthogonal centre.
template <int D>
std::set<std::pair<std::uint32_t, std::uint32_t>> brute_edges(const std::vector<double>& x,
                                                              const std::vector<double>& r) {
  const auto at = [&](std::size_t i) { return Vec<D>(Eigen::Map<const Vec<D>>(x.data() + i * D)); };
  const auto weight = [&](std::size_t i) { return at(i).squaredNorm() - r[i] * r[i]; };
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<char> chosen(r.size(), 0);
  std::fill_n(chosen.begin(), D + 1, 1);
  do {
    std::vector<std::size_t> corner;
    for (std::size_t i = 0; i < r.size(); ++i) {
      if (chosen[i] != 0)
        corner.push_back(i);
    }
    // |c − x_i|² − r_i² is the same for all corners: D linear equations for c.
    Eigen::Matrix<double, D, D> m;
    Vec<D> b;
    for (int k = 0; k < D; ++k) {
      const std::size_t i = corner[static_cast<std::size_t>(k) + 1];
      m.row(k) = 2 * (at(i) - at(corner[0])).transpose();
      b[k] = weight(i) - weight(corner[0]);
    }
    const Vec<D> c = m.fullPivLu().solve(b);
    const auto power = [&](std::size_t i) { return (c - at(i)).squaredNorm() - r[i] * r[i]; };
    const double own = power(corner[0]);
    bool empty = true;
    for (std::size_t i = 0; i < r.size() && empty; ++i)
      empty = chosen[i] != 0 || power(i) >= own;
    if (empty) {
      for (const std::size_t i : corner) {
        for (const std::size_t j : corner) {
          if (i < j)
            edges.emplace(i, j);
        }
      }
    }
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return edges;
}

template <int D>
void agrees_with_the_definition() {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    RandomStream random("triangulation", seed);
    std::vector<double> x(20 * D);
    std::vector<double> r(20);
    std::generate(x.begin(), x.end(), [&] { return random.uniform(); });
    std::generate(r.begin(), r.end(), [&] { return 0.01 + 0.2 * random.uniform(); });
    const Adjacency found = power_neighbours<D>(x, r);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t i = 0; i < 20; ++i) {
      CHECK(std::is_sorted(found.of(i).begin(), found.of(i).end()));
      for (const std::uint32_t j : found.of(i)) {
        CHECK(std::binary_search(found.of(j).begin(), found.of(j).end(), i));
        edges.emplace(std::min(i, j), std::max(i, j));
      }
    }
    CHECK(edges == brute_edges<D>(x, r));
  }
}

} // namespace

TEST_CASE("power neighbours are those of the definition") {
  agrees_with_the_definition<2>();
  agrees_with_the_definition<3>();
}

TEST_CASE("on a lattice every nearest neighbour is a power neighbour, however degenerate the points") {
  std::vector<double> x;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      for (int k = 0; k < 6; ++k)
        x.insert(x.end(), {1.0 * i, 1.0 * j, 1.0 * k});
    }
  }
  const std::vector<double> r(216, 0.5);
  const Adjacency found = power_neighbours<3>(x, r);
  const std::size_t middle = (2 * 6 + 2) * 6 + 2;
  for (const std::size_t step : {1U, 6U, 36U}) {
    CHECK(std::binary_search(found.of(middle).begin(), found.of(middle).end(), middle + step));
    CHECK(std::binary_search(found.of(middle).begin(), found.of(middle).end(), middle - step));
  }
}
