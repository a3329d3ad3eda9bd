// Forces, virial and stiffness of overlapping spheres against derivatives of the energy, and on any number of threads.
#include "engine/base/random.h"
#include "engine/dem/overlap_forces.h"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>

#include <string>

using namespace tamp;

namespace {

template <int D>
struct Cloud {
  Vec<D> size = Vec<D>::Ones();
  std::vector<double> positions;
  std::vector<double> radii;

  Cloud(std::size_t n, double phi, std::uint64_t seed) {
    RandomStream draw("overlap forces", seed);
    double filled = 0;
    for (std::size_t i = 0; i < n; ++i) {
      radii.push_back(0.3 + draw.uniform());
      filled += (D == 2 ? 3.14159 : 4.18879) * std::pow(radii.back(), D);
    }
    const double edge = std::pow(filled / phi, 1.0 / D);
    for (int a = 0; a < D; ++a)
      size[a] = edge * (1 + 0.1 * a);
    for (std::size_t i = 0; i < n * D; ++i)
      positions.push_back(draw.uniform() * size[static_cast<int>(i % D)]);
  }
};

struct Result {
  ContactSums sums;
  std::vector<double> forces;
  std::vector<double> stiffness;
  bool operator==(const Result& o) const {
    return sums.energy == o.sums.energy && sums.virial == o.sums.virial && forces == o.forces &&
           stiffness == o.stiffness;
  }
};

template <int D>
Result evaluated(const Cloud<D>& cloud) {
  std::array<bool, D> periodic;
  periodic.fill(true);
  NeighbourList<D> list(periodic, cloud.radii, 0.1);
  Result r;
  auto positions = cloud.positions;
  list.update(cloud.size, positions);
  r.forces.resize(positions.size());
  r.stiffness.resize(cloud.radii.size());
  r.sums = OverlapForces<D>().evaluate(list, positions, cloud.radii, r.forces, r.stiffness);
  return r;
}

template <int D>
void check_derivatives() {
  constexpr double h = 1e-6;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Cloud<D> cloud(60, 0.9, seed);
    const Result here = evaluated(cloud);
    REQUIRE(here.sums.contacts > 60);
    const auto energy_at = [&](auto change) {
      Cloud<D> other = cloud;
      change(other);
      return evaluated(other).sums.energy;
    };
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
      const double slope = (energy_at([&](Cloud<D>& c) { c.positions[i] += h; }) -
                            energy_at([&](Cloud<D>& c) { c.positions[i] -= h; })) /
                           (2 * h);
      CHECK(here.forces[i] == Approx(-slope).margin(1e-5));
    }
    const auto widened = [&](double e) {
      return energy_at([&](Cloud<D>& c) {
        c.size *= std::exp(e);
        for (double& x : c.positions)
          x *= std::exp(e);
      });
    };
    CHECK(here.sums.virial == Approx(-(widened(h) - widened(-h)) / (2 * h)).epsilon(1e-5));
    double stiffness = 0;
    for (const double k : here.stiffness)
      stiffness += k;
    CHECK(stiffness > 0);
    if (D == 2) // every contact has stiffness 1 and belongs to two spheres
      CHECK(stiffness == Approx(2 * here.sums.contacts));
  }
}

} // namespace

TEST_CASE("forces and virial are the slopes of the energy") {
  check_derivatives<2>();
  check_derivatives<3>();
}

TEST_CASE("two spheres: closed form") {
  Cloud<3> c(1, 0.1, 0);
  c.size.setConstant(10);
  c.radii = {1, 2};
  c.positions = {9.5, 5, 5, 2, 5, 5}; // through the face: 2.5 apart, overlap 0.5
  const Result r = evaluated(c);
  CHECK(r.sums.contacts == 1);
  CHECK(r.sums.energy == Approx(0.125));
  CHECK(r.sums.virial == Approx(0.5 * 2.5));
  CHECK(r.sums.deepest == Approx(0.5));
  CHECK(r.forces[0] == Approx(-0.5));
  CHECK(r.forces[3] == Approx(0.5));
}

TEST_CASE("forces have the same bits on one thread and on two") {
  const Cloud<3> cloud(10000, 0.7, 7);
  const auto run = [&](std::size_t threads) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    return evaluated(cloud);
  };
  CHECK(run(1) == run(2));
}
