// Lattices: touching, inside, of the right number, and refused where they make no sense.
#include "engine/generate/lattice.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tamp;

namespace {

Job lattice_job(LatticeKind kind, int dimension, std::vector<double> size, double radius) {
  Job job;
  job.scene.dimension = dimension;
  job.scene.size = std::move(size);
  job.scene.psd = Psd{};
  job.scene.psd.law = Law::monodisperse;
  job.scene.psd.radius = radius;
  job.method.name = MethodName::lattice;
  job.method.lattice.kind = kind;
  return job;
}

struct Row {
  LatticeKind kind;
  int dimension;
  int neighbours;
};

const std::vector<Row> kRows = {{LatticeKind::square, 2, 4}, {LatticeKind::hexagonal, 2, 6}, {LatticeKind::sc, 3, 6},
                                {LatticeKind::bcc, 3, 8},    {LatticeKind::fcc, 3, 12},      {LatticeKind::hcp, 3, 12}};

double measure_of(const Generated& made, const std::string& name) {
  for (const Measure& m : made.measures) {
    if (m.name == name)
      return m.value;
  }
  return std::nan("");
}

} // namespace

TEST_CASE("spheres of a lattice touch, do not overlap, and stay in the box") {
  constexpr double kRounding = 1e-13;
  for (const Row& row : kRows) {
    for (const double radius : {1.0, 1.7e-6}) {
      CAPTURE(name_of(row.kind), radius);
      const auto d = static_cast<std::size_t>(row.dimension);
      std::vector<double> size{11.3 * radius, 12.9 * radius, 10.0 * radius};
      size.resize(d);
      const Generated made = generate_lattice({lattice_job(row.kind, row.dimension, size, radius), "key"});
      REQUIRE(made.outcome == Outcome::ok);
      const Packing& p = made.packing;
      CHECK(measure_of(made, "N") == static_cast<double>(p.count()));
      CHECK(p.dimension == row.dimension);
      CHECK(p.boundary[0] == Boundary::wall);
      CHECK(made.effects.simulated.empty());

      for (std::size_t a = 0; a < d; ++a)
        CHECK(p.positions[a] == Approx(radius).epsilon(kRounding)); // the first sphere is in the corner
      int most = 0;
      for (std::size_t i = 0; i < p.count(); ++i) {
        int touching = 0;
        for (std::size_t a = 0; a < d; ++a) {
          REQUIRE(p.positions[i * d + a] >= radius * (1 - kRounding));
          REQUIRE(p.positions[i * d + a] <= size[a] - radius * (1 - kRounding));
        }
        for (std::size_t j = 0; j < p.count(); ++j) {
          double squared = 0;
          for (std::size_t a = 0; a < d; ++a)
            squared += std::pow(p.positions[i * d + a] - p.positions[j * d + a], 2);
          const double gap = std::sqrt(squared) / radius - 2;
          if (i == j)
            continue;
          REQUIRE(gap > -kRounding * 10);
          touching += gap < kRounding * 10 ? 1 : 0;
        }
        most = std::max(most, touching);
      }
      CHECK(most == row.neighbours);
    }
  }
}

TEST_CASE("a layer that fits exactly is there, one that misses by a hair is not") {
  for (const double unit : {1.0, 0.1, 1e-6}) {
    CAPTURE(unit);
    const auto count = [&](double edge) {
      const auto made = generate_lattice({lattice_job(LatticeKind::sc, 3, {edge, edge, edge}, unit), "key"});
      return made.packing.count();
    };
    CHECK(count(14 * unit) == 343);
    CHECK(count(13.999 * unit) == 216);
    CHECK(count(2 * unit) == 1);
  }
}

TEST_CASE("the count of the scene limits the spheres, from the floor up") {
  Job job = lattice_job(LatticeKind::square, 2, {10, 10}, 1);
  job.scene.count = 7;
  const Generated some = generate_lattice({job, "key"});
  REQUIRE(some.packing.count() == 7);
  CHECK(some.packing.positions[2 * 6 + 1] == 3); // two in the second row
  job.scene.count = 26;
  const Generated none = generate_lattice({job, "key"});
  CHECK(none.outcome == Outcome::not_applicable);
  CHECK(none.reason == "the box has 25 places of the lattice, the scene wants 26");
}

TEST_CASE("scenes that no lattice fits are not applicable, with the reason") {
  CHECK(generate_lattice({lattice_job(LatticeKind::fcc, 2, {10, 10}, 1), "key"}).reason ==
        "the lattice fcc is 3D, the scene 2D");
  CHECK(generate_lattice({lattice_job(LatticeKind::square, 3, {10, 10, 10}, 1), "key"}).outcome ==
        Outcome::not_applicable);

  Job periodic = lattice_job(LatticeKind::sc, 3, {10, 10, 10}, 1);
  periodic.scene.sides = Sides::periodic;
  CHECK(generate_lattice({periodic, "key"}).outcome == Outcome::not_applicable);

  Job two_sizes = lattice_job(LatticeKind::sc, 3, {10, 10, 10}, 1);
  two_sizes.scene.psd = Psd{};
  two_sizes.scene.psd.law = Law::bimodal;
  two_sizes.scene.psd.small_radius = 1;
  two_sizes.scene.psd.size_ratio = 2;
  two_sizes.scene.psd.large_volume_fraction = 0.5;
  const Generated made = generate_lattice({two_sizes, "key"});
  CHECK(made.outcome == Outcome::not_applicable);
  CHECK(made.packing.count() == 0);
}
