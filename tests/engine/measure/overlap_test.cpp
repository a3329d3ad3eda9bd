// Overlaps of two spheres, of spheres with walls, and none in lattices.
#include "tests/engine/measure/packings.h"

using namespace tamp;
using namespace tamp::test;

namespace {

std::vector<Measure> overlap(const Packing& packing) {
  return measure(metric_of(MetricName::overlap), packing, {});
}

} // namespace

TEST_CASE("an overlap counts relative to the smaller sphere") {
  Packing packing = box_of(3, 20);
  add(packing, {5, 5, 5}, 3);
  add(packing, {5, 8.9, 5}, 1); // 0.1 deep
  const auto found = overlap(packing);
  CHECK(value_of(found, "overlap_max") == Approx(0.1).epsilon(1e-12));
  CHECK(value_of(found, "overlap_pairs") == 1);
  CHECK(value_of(found, "overlap_walls") == 0);
}

TEST_CASE("exact contacts of a lattice are no overlaps, with walls and across periodic sides") {
  for (const int dimension : {2, 3}) {
    for (const Boundary boundary : {Boundary::wall, Boundary::periodic, Boundary::open}) {
      const auto found = overlap(cubic_packing(dimension, 4, 0.1, boundary));
      CHECK(value_of(found, "overlap_max") < 1e-14);
      CHECK(value_of(found, "overlap_pairs") == 0);
      CHECK(value_of(found, "overlap_walls") == 0);
    }
  }
}

TEST_CASE("a sphere through a wall, across a periodic side, and above a box without a lid") {
  Packing packing = box_of(2, 10);
  packing.boundary = {Boundary::wall, Boundary::open, Boundary::wall};
  add(packing, {0.8, 5}, 1);
  add(packing, {5, 9.5}, 1); // through the missing lid
  CHECK(value_of(overlap(packing), "overlap_max") == Approx(0.2).epsilon(1e-12));
  CHECK(value_of(overlap(packing), "overlap_walls") == 1);
  add(packing, {5, 0.5}, 1); // the floor is there all the same
  CHECK(value_of(overlap(packing), "overlap_max") == Approx(0.5).epsilon(1e-12));
  CHECK(value_of(overlap(packing), "overlap_walls") == 2);

  Packing periodic = box_of(2, 10, Boundary::periodic);
  add(periodic, {0.5, 5}, 1);
  add(periodic, {9, 5}, 1);
  CHECK(value_of(overlap(periodic), "overlap_max") == Approx(0.5).epsilon(1e-12));
  CHECK(value_of(overlap(periodic), "overlap_pairs") == 1);
}

TEST_CASE("pairs count above the tolerance of rounding only") {
  for (const double depth : {0.5e-10, 2e-10}) {
    Packing packing = box_of(2, 10);
    add(packing, {5, 5}, 1);
    add(packing, {7 - depth, 5}, 1);
    CHECK(value_of(overlap(packing), "overlap_max") == Approx(depth).epsilon(1e-4));
    CHECK(value_of(overlap(packing), "overlap_pairs") == (depth > 1e-10 ? 1 : 0));
  }
}
