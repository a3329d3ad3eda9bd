// Bond order of the lattices, whose numbers are known, of single bonds, and of disorder.
#include "tests/engine/measure/packings.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace tamp;
using namespace tamp::test;

namespace {

using Basis = std::vector<std::array<double, 3>>;

/// n unit cells along each axis, periodic; the basis in units of the cell's edges.
Packing crystal(const Basis& basis, std::array<double, 3> edges, int n, double radius) {
  Packing packing = box_of(3, 1);
  for (std::size_t a = 0; a < 3; ++a) {
    packing.size[a] = n * edges[a];
    packing.boundary[a] = Boundary::periodic;
  }
  for (int i = 0; i < n * n * n; ++i) {
    const std::array<int, 3> cell = {i % n, i / n % n, i / n / n};
    for (const auto& point : basis) {
      for (std::size_t a = 0; a < 3; ++a)
        packing.positions.push_back((cell[a] + point[a]) * edges[a]);
      packing.radii.push_back(radius);
    }
  }
  return packing;
}

double order_of(const Packing& packing, const char* name) {
  return measured(name, packing, metric_of(MetricName::bond_order), {});
}

} // namespace

TEST_CASE("the lattices have the published Q6") {
  // Steinhardt, Nelson & Ronchetti (1983) and, with the fourteen neighbours of two shells for BCC, ten Wolde et al.
  // (1996).
  const double root2 = std::sqrt(2.0);
  struct Known {
    const char* name;
    Packing packing;
    double q6;
    double neighbours;
  };
  const std::array<Known, 4> lattices = {
      Known{"SC", crystal({{0, 0, 0}}, {2, 2, 2}, 4, 1), 0.35355, 6},
      Known{"BCC",
            crystal({{0, 0, 0}, {.5, .5, .5}}, {4 / std::sqrt(3.0), 4 / std::sqrt(3.0), 4 / std::sqrt(3.0)}, 4, 1),
            0.51069, 14},
      Known{"FCC", crystal({{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}}, {2 * root2, 2 * root2, 2 * root2}, 3, 1),
            0.57452, 12},
      Known{"HCP",
            crystal({{0, 0, 0}, {.5, .5, 0}, {.5, 5.0 / 6, .5}, {0, 1.0 / 3, .5}},
                    {2, 2 * std::sqrt(3.0), 4 * std::sqrt(2.0 / 3)}, 3, 1),
            0.48476, 12},
  };
  for (const Known& lattice : lattices) {
    CAPTURE(lattice.name);
    CHECK(order_of(lattice.packing, "Q6") == Approx(lattice.q6).margin(1e-5));
    CHECK(order_of(lattice.packing, "Q6_local") == Approx(lattice.q6).margin(1e-5));
    CHECK(order_of(lattice.packing, "neighbours") == lattice.neighbours);
    // A simple cubic lattice has too few neighbours for a crystal in this sense; spheres at rest do not form it.
    CHECK(order_of(lattice.packing, "crystalline") == (lattice.neighbours > 6 ? 1 : 0));
  }
}

TEST_CASE("a single bond has order 1, in any direction") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    RandomStream draw("bond", seed);
    const double z = 2 * draw.uniform() - 1;
    const double angle = 6.283185307179586 * draw.uniform();
    const double flat = std::sqrt(1 - z * z);
    Packing pair = box_of(3, 10);
    pair.radii = {1, 1};
    pair.positions = {5, 5, 5, 5 + 2 * flat * std::cos(angle), 5 + 2 * flat * std::sin(angle), 5 + 2 * z};
    CHECK(order_of(pair, "Q6") == Approx(1));
    Packing flat_pair = box_of(2, 10);
    flat_pair.radii = {1, 1};
    flat_pair.positions = {5, 5, 5 + 2 * std::cos(angle), 5 + 2 * std::sin(angle)};
    CHECK(order_of(flat_pair, "psi6") == Approx(1));
  }
}

TEST_CASE("in the plane the hexagonal lattice is a crystal and the square one is not") {
  Packing hexagonal = box_of(2, 1);
  hexagonal.size = {12, 6 * std::sqrt(3.0), hexagonal.size[2]};
  hexagonal.boundary = {Boundary::periodic, Boundary::periodic, hexagonal.boundary[2]};
  for (int i = 0; i < 36; ++i) {
    hexagonal.positions.insert(hexagonal.positions.end(), {2.0 * (i % 6) + (i / 6) % 2, std::sqrt(3.0) * (i / 6)});
    hexagonal.radii.push_back(1);
  }
  CHECK(order_of(hexagonal, "psi6") == Approx(1));
  CHECK(order_of(hexagonal, "crystalline") == 1);
  const Packing square = cubic_packing(2, 6, 1, Boundary::periodic);
  CHECK(order_of(square, "psi6") == Approx(0).margin(1e-12));
  CHECK(order_of(square, "crystalline") == 0);
}

TEST_CASE("disorder has little order of all bonds, and no crystals") {
  RandomStream draw("disorder", 1);
  const Packing gas = random_packing(3, 4000, 24, 1, Boundary::periodic, draw);
  CHECK(order_of(gas, "Q6") < 0.05); // falls with the root of the number of bonds
  CHECK(order_of(gas, "crystalline") < 0.05);
}

TEST_CASE("a sphere alone has no order") {
  Packing one = box_of(3, 10);
  one.radii = {1};
  one.positions = {5, 5, 5};
  for (const char* name : {"Q6", "Q6_local", "crystalline", "neighbours"})
    CHECK(order_of(one, name) == 0);
}
