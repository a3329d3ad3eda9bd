// Descents that contacts leave free, and spheres that rest or fall.
#include "engine/measure/support.h"
#include "tests/engine/measure/packings.h"

#include <Eigen/Dense>

using namespace tamp;
using namespace tamp::test;

namespace {

template <int D>
double descent(const std::vector<Vec<D>>& normals) {
  return free_descent<D>(normals);
}

std::vector<Measure> stable(const Packing& packing) {
  return measure(metric_of(MetricName::stable_alone), packing, {});
}

/// A sphere of radius 1 at the top of spheres of radius 1 on a circle at the given angles, its centre 1.2 above theirs.
Packing heap(std::vector<double> angles, double shift = 0) {
  Packing packing = box_of(3, 20);
  add(packing, {10 + shift, 10, 2.2}, 1);
  const double away = std::sqrt(4 - 1.2 * 1.2);
  for (const double angle : angles)
    add(packing, {10 + shift + away * std::cos(angle), 10 + away * std::sin(angle), 1}, 1);
  return packing;
}

constexpr double kTurn = 6.283185307179586;

} // namespace

TEST_CASE("the descent that contacts leave free, in closed form") {
  CHECK(descent<3>({}) == 1);                                                    // free fall
  CHECK(descent<3>({{0, 0, 1}}) == Approx(0).margin(1e-15));                     // a floor
  CHECK(descent<3>({{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}) == 1);                   // walls and a lid carry nothing
  CHECK(descent<3>({{0.6, 0, 0.8}}) == Approx(0.6));                             // a slope
  CHECK(descent<3>({{0.6, 0, 0.8}, {-0.6, 0, 0.8}}) == Approx(0).margin(1e-15)); // a saddle's top
  CHECK(descent<2>({{0.6, 0.8}, {-1, 0}}) == Approx(0).margin(1e-15));           // wedged against a wall
  // Wedged under an overhang: the contact that stops it points down.
  CHECK(descent<2>({{0.6, 0.8}, {-0.8, -0.6}}) == Approx(0).margin(1e-15));
  CHECK(descent<2>({{0.6, 0.8}, {-0.6, -0.8}}) == Approx(0.6)); // squarely opposed: it slides along both
}

TEST_CASE("the free descent agrees with a search over all sets of contacts") {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    RandomStream draw("support", seed);
    std::vector<Vec<3>> normals(1 + draw.below(6));
    for (auto& n : normals) {
      do {
        for (int a = 0; a < 3; ++a)
          n[a] = 2 * draw.uniform() - 1;
      } while (n.norm() < 0.1 || n.norm() > 1);
      n.normalize();
    }
    // The least distance to the span of any set of contacts whose multipliers come out positive.
    double least = 1;
    for (unsigned set = 1; set < (1U << normals.size()); ++set) {
      std::vector<Vec<3>> chosen;
      for (std::size_t i = 0; i < normals.size(); ++i) {
        if ((set >> i & 1U) != 0)
          chosen.push_back(normals[i]);
      }
      if (chosen.size() > 3)
        continue;
      Eigen::MatrixXd a(3, static_cast<Eigen::Index>(chosen.size()));
      for (std::size_t i = 0; i < chosen.size(); ++i)
        a.col(static_cast<Eigen::Index>(i)) = chosen[i];
      const Eigen::VectorXd lambda = a.colPivHouseholderQr().solve(Vec<3>(0, 0, 1));
      if (lambda.minCoeff() >= 0)
        least = std::min(least, (a * lambda - Vec<3>(0, 0, 1)).norm());
    }
    CAPTURE(seed);
    CHECK(descent<3>(normals) == Approx(least).margin(1e-12));
  }
}

TEST_CASE("a sphere rests on three supports around it and falls off three on one side") {
  CHECK(value_of(stable(heap({0, kTurn / 3, 2 * kTurn / 3})), "unstable_count") == 0);
  const auto fallen = stable(heap({0, 0.35 * kTurn, 0.17 * kTurn}));
  CHECK(value_of(fallen, "unstable_count") == 1);
  CHECK(value_of(fallen, "stable_alone") == Approx(0.75));
  CHECK(value_of(stable(heap({})), "unstable_count") == 1); // in the air
  CHECK(value_of(stable(heap({0.4})), "unstable_count") == 1);
}

TEST_CASE("two supports that face each other exactly hold a sphere, up to rounding") {
  for (const double angle : {0.0, 0.3, 1.1, 2.9}) {
    CAPTURE(angle);
    CHECK(value_of(stable(heap({angle, angle + kTurn / 2})), "unstable_count") == 0);
    CHECK(value_of(stable(heap({angle, angle + kTurn / 2 + 1e-5})), "unstable_count") == 1);
  }
}

TEST_CASE("what touches from above holds nothing") {
  Packing packing = box_of(3, 20);
  add(packing, {5, 5, 5}, 1);
  for (const double angle : {0.0, kTurn / 3, 2 * kTurn / 3})
    add(packing, {5 + 1.6 * std::cos(angle), 5 + 1.6 * std::sin(angle), 6.2}, 1);
  CHECK(value_of(stable(packing), "unstable_count") == 4);
}

TEST_CASE("floors, side walls and periodic sides support; lids and open sides do not") {
  Packing floor = box_of(2, 10, Boundary::open);
  add(floor, {5, 1}, 1);
  CHECK(value_of(stable(floor), "unstable_count") == 0);

  Packing lid = box_of(2, 10);
  add(lid, {5, 9}, 1);
  CHECK(value_of(stable(lid), "unstable_count") == 1);

  // A disc of radius 1 wedged between the side wall and a disc on the floor.
  for (const Boundary side : {Boundary::wall, Boundary::open}) {
    Packing wedge = box_of(2, 10);
    wedge.boundary[0] = side;
    add(wedge, {2, 1}, 1);
    add(wedge, {1, 1 + std::sqrt(3)}, 1);
    CHECK(value_of(stable(wedge), "unstable_count") == (side == Boundary::wall ? 0 : 1));
  }

  // In the saddle of two floor discs, one of them seen through the periodic side.
  Packing saddle = box_of(2, 10);
  saddle.boundary[0] = Boundary::periodic;
  add(saddle, {1, 1}, 1);
  add(saddle, {9, 1}, 1);
  add(saddle, {10, 1 + std::sqrt(3)}, 1);
  CHECK(value_of(stable(saddle), "unstable_count") == 0);
}
