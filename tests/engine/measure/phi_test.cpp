// Packing fractions of packings that can be worked out by hand, or counted by points.
#include "engine/base/error.h"
#include "engine/measure/sub_box.h"
#include "tests/engine/measure/packings.h"

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr double kPi = 3.14159265358979323846;

double phi_of(const Packing& packing, double inset = 0.05) {
  Metric metric = metric_of(MetricName::phi);
  metric.inset = inset;
  return measured("phi", packing, metric, {});
}

/// Spheres of the whole packing and its images around each point of the sub-box, averaged over points.
template <int D>
double counted_by_points(const Packing& packing, double inset, int points, RandomStream& draw) {
  const SubBox<D> box = sub_box<D>(packing, inset);
  int hits = 0;
  for (int k = 0; k < points; ++k) {
    Vec<D> x;
    for (int a = 0; a < D; ++a)
      x[a] = box.low[a] + (box.high[a] - box.low[a]) * draw.uniform();
    for (std::size_t i = 0; i < packing.count(); ++i) {
      Vec<D> d = x - packing.centre<D>(i);
      for (int a = 0; a < D; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        if (packing.boundary[axis] == Boundary::periodic)
          d[a] -= std::round(d[a] / packing.size[axis]) * packing.size[axis]; // spheres are smaller than half the box
      }
      hits += d.squaredNorm() < packing.radii[i] * packing.radii[i] ? 1 : 0;
    }
  }
  return static_cast<double>(hits) / points;
}

} // namespace

TEST_CASE("phi of a whole periodic box is the volume of its spheres over that of the box") {
  for (const int dimension : {2, 3}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      RandomStream draw("phi, periodic", seed);
      Packing packing = random_packing(dimension, 50, 3, 2.5, Boundary::periodic, draw); // some larger than the box
      double volume = 0;
      for (const double r : packing.radii)
        volume += dimension == 2 ? kPi * r * r : 4 * kPi / 3 * r * r * r;
      CAPTURE(dimension, seed);
      const double expected = volume / std::pow(3, dimension);
      CHECK(phi_of(packing, 0) == Approx(expected).epsilon(1e-12));
      packing.positions[0] += 7 * packing.size[0]; // images are the same packing
      CHECK(phi_of(packing, 0) == Approx(expected).epsilon(1e-12));
    }
  }
}

TEST_CASE("phi counts every sphere that reaches into the sub-box") {
  constexpr int kPoints = 20000;
  for (const Boundary boundary : {Boundary::wall, Boundary::periodic, Boundary::open}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      RandomStream draw("phi, points", seed);
      const Packing flat = random_packing(2, 40, 1, 0.4, boundary, draw);
      const Packing solid = random_packing(3, 40, 1, 0.4, boundary, draw);
      CAPTURE(name_of(boundary), seed);
      const double flat_points = counted_by_points<2>(flat, 0.2, kPoints, draw);
      const double solid_points = counted_by_points<3>(solid, 0.2, kPoints, draw);
      // A point lies in several spheres at once: the variance is at most about that of 4 phi.
      CHECK(std::abs(phi_of(flat, 0.2) - flat_points) < 5 * std::sqrt(4 * flat_points / kPoints));
      CHECK(std::abs(phi_of(solid, 0.2) - solid_points) < 5 * std::sqrt(4 * solid_points / kPoints));
    }
  }
}

TEST_CASE("the paper's estimator on one disc in reach of one face, by hand") {
  // Centres span 0…10; the sub-box is 0.5…9.5. The disc at (1, 5) of radius 1 loses the segment beyond x = 0.5; the
  // discs at the corners of the span are centred outside and do not count, though they reach in.
  Packing packing = box_of(2, 20);
  add(packing, {0, 0}, 1);
  add(packing, {10, 10}, 1);
  add(packing, {1, 5}, 1);
  const double segment = std::acos(0.5) - 0.5 * std::sqrt(0.75);
  const auto measures = measure(metric_of(MetricName::phi_paper), packing, {});
  CHECK(value_of(measures, "phi_paper") == Approx((kPi - segment) / 81).epsilon(1e-14));
  CHECK(value_of(measures, "N_PB") == 1);
}

TEST_CASE("the paper's estimator subtracts what two faces share twice") {
  Packing packing = box_of(3, 20);
  add(packing, {0, 0, 0}, 0.1);
  add(packing, {10, 10, 10}, 0.1);
  add(packing, {1, 1, 5}, 1); // 0.5 from two faces
  const double cap = kPi * 0.25 * (3 - 0.5) / 3;
  CHECK(measured("phi_paper", packing, metric_of(MetricName::phi_paper), {}) ==
        Approx((4 * kPi / 3 - 2 * cap) / 729).epsilon(1e-14));
}

TEST_CASE("the paper's estimator is low in a homogeneous bed by what it leaves out") {
  // Spheres at independent places: the expected loss is the caps of spheres centred outside, ~ (9/8) phi <R⁴>/<R³> /
  // edge.
  RandomStream draw("phi, bias", 0);
  constexpr double kEdge = 30;
  Packing packing = box_of(3, kEdge, Boundary::periodic);
  for (int i = 0; i < 60000; ++i)
    add(packing, {kEdge * draw.uniform(), kEdge * draw.uniform(), kEdge * draw.uniform()}, 1);
  const double phi = phi_of(packing);
  const double paper = measured("phi_paper", packing, metric_of(MetricName::phi_paper), {});
  const double expected = 9.0 / 8 * phi / (0.9 * kEdge);
  CHECK(phi == Approx(60000 * 4 * kPi / 3 / std::pow(kEdge, 3)).epsilon(0.01));
  CHECK(phi - paper == Approx(expected).epsilon(0.15));
}

TEST_CASE("spheres whose centres span no volume have no density") {
  Packing one = box_of(3, 10);
  add(one, {5, 5, 5}, 1);
  CHECK_THROWS_AS(phi_of(one), Error);
  Packing row = one;
  add(row, {7, 5, 5}, 1);
  CHECK_THROWS_WITH(phi_of(row), Catch::Contains("span only 0 along axis 1"));
  Packing level = one; // by rounding no length of a box, and by chance not zero
  add(level, {8, 8, 5 + 1e-15}, 1);
  CHECK_THROWS_AS(phi_of(level), NotApplicable);
  CHECK_THROWS_AS(measure(metric_of(MetricName::phi_paper), level, {}), NotApplicable);
  Packing periodic = box_of(3, 10, Boundary::periodic);
  add(periodic, {5, 5, 5}, 1);
  CHECK(phi_of(periodic, 0) == Approx(4 * kPi / 3 / 1000).epsilon(1e-14));
}

TEST_CASE(
    "the standard error of phi is 0 for a lattice whose parts are alike, and foretells the scatter of random ones") {
  // One sphere in each third of the box along each axis, periodic: all 27 parts are the same.
  Packing lattice = box_of(3, 9);
  lattice.boundary = {Boundary::periodic, Boundary::periodic, Boundary::periodic};
  for (int i = 0; i < 27; ++i) {
    for (const int k : {i % 3, i / 3 % 3, i / 9})
      lattice.positions.push_back(1.5 + 3 * k);
    lattice.radii.push_back(1);
  }
  Metric whole = metric_of(MetricName::phi);
  whole.inset = 0;
  CHECK(measured("phi_se", lattice, whole, {}) == Approx(0).margin(1e-14));

  for (const int dimension : {2, 3}) {
    std::vector<double> found;
    double told = 0;
    constexpr int kPackings = 200;
    for (std::uint64_t seed = 0; seed < kPackings; ++seed) {
      RandomStream draw("standard error of phi", seed);
      const Packing gas = random_packing(dimension, 400, 20, 0.4, Boundary::wall, draw);
      Metric inner = metric_of(MetricName::phi);
      inner.inset = 0.2; // spheres come and go through the faces of the sub-box, as independent parts would have it
      found.push_back(measured("phi", gas, inner, {}));
      told += measured("phi_se", gas, inner, {}) / kPackings;
    }
    double mean = 0;
    for (const double phi : found)
      mean += phi / kPackings;
    double variance = 0;
    for (const double phi : found)
      variance += (phi - mean) * (phi - mean) / (kPackings - 1);
    CAPTURE(dimension, mean, told);
    CHECK(told == Approx(std::sqrt(variance)).epsilon(0.25));
  }
}
