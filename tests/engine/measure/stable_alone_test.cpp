// Hulls of support points, and spheres that rest or fall.
#include "engine/measure/support.h"
#include "tests/engine/measure/packings.h"

using namespace tamp;
using namespace tamp::test;

namespace {

bool rests(std::vector<Vec<2>> points, double tolerance = 0) {
  return rests_on<3>(points, tolerance);
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

TEST_CASE("the origin in the hull of points, decided exactly") {
  CHECK(rests({{1, 0}, {-1, 1}, {-1, -1}}));
  CHECK(rests({{1, 0}, {-1, 0}, {0, 1}}));                 // on an edge
  CHECK_FALSE(rests({{1, 1e-100}, {-1, 1e-100}, {0, 1}})); // above it by the least there is
  CHECK(rests({{1, -1e-100}, {-1, 1e-100}, {0, 1}}));
  CHECK(rests({{0, 0}}));
  CHECK(rests({{0.3, 0.6}, {-0.1, -0.2}}, 1e-15));
  CHECK_FALSE(rests({{0.3, 0.6}, {-0.1, -0.3}}, 1e-6));
  CHECK_FALSE(rests({}));
  CHECK_FALSE(rests({{0.1, 0}, {0.1, 0}, {0.1, 0}}));
}

TEST_CASE("the tolerance is a distance from the hull") {
  const std::vector<Vec<2>> points{{1, 0.01}, {-1, 0.01}, {0, 1}};
  CHECK(rests(points, 0.0101));
  CHECK_FALSE(rests(points, 0.0099));
  CHECK(rests({{0.03, 0.04}}, 0.0501));
  CHECK_FALSE(rests({{0.03, 0.04}}, 0.0499));
}

TEST_CASE("hulls of random points agree with a search for a separating line") {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    RandomStream draw("support", seed);
    std::vector<Vec<2>> points(1 + draw.below(5));
    for (auto& p : points)
      p = {2 * draw.uniform() - 1, 2 * draw.uniform() - 1};
    // A separating line may be turned until it is square to a point: try the directions just beside those.
    bool separated = false;
    for (const auto& p : points) {
      for (const double side : {1.0, -1.0}) {
        const Vec<2> direction = Vec<2>(-p[1], p[0]) * side + 1e-9 * p;
        bool all = true;
        for (const auto& other : points)
          all = all && other.dot(direction) > 0;
        separated = separated || all;
      }
    }
    CAPTURE(seed);
    CHECK(rests(points) == !separated);
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
