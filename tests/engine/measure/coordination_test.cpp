// Contact numbers of lattices, and rattlers taken away one after the other.
#include "tests/engine/measure/packings.h"

using namespace tamp;
using namespace tamp::test;

namespace {

std::vector<Measure> coordination(const Packing& packing) {
  return measure(metric_of(MetricName::coordination), packing, {});
}

} // namespace

TEST_CASE("every sphere of a periodic cubic lattice touches 2d others, however small the box") {
  for (const int dimension : {2, 3}) {
    for (const int edge : {1, 2, 3, 7}) {
      CAPTURE(dimension, edge);
      const auto found = coordination(cubic_packing(dimension, edge, 0.1, Boundary::periodic));
      CHECK(value_of(found, "z") == 2 * dimension);
      CHECK(value_of(found, "z_no_rattlers") == 2 * dimension);
      CHECK(value_of(found, "rattlers") == 0);
    }
  }
}

TEST_CASE("between walls the missing contacts are those with walls, which z leaves out") {
  const auto found = coordination(cubic_packing(3, 5, 1, Boundary::wall));
  CHECK(value_of(found, "z") == Approx(2.0 * 3 * 4 * 25 / 125));
  CHECK(value_of(found, "rattlers") == 0); // corner spheres touch three spheres and three walls
}

TEST_CASE("rattlers are removed until none is left") {
  // A chain of discs in the air: only the ends lack contacts at first, and then all go.
  Packing chain = box_of(2, 100);
  for (int i = 0; i < 6; ++i)
    add(chain, {20.0 + 2 * i, 50}, 1);
  const auto none = coordination(chain);
  CHECK(value_of(none, "z") == Approx(2.0 * 5 / 6));
  CHECK(value_of(none, "z_no_rattlers") == 0);
  CHECK(value_of(none, "rattlers") == 1);

  // A square lattice in walls with a disc loose in a hole: its neighbours keep three contacts and stay.
  Packing hole = cubic_packing(2, 7, 1, Boundary::wall);
  const std::size_t centre = 24;
  hole.radii[centre] = 0.5;
  const auto found = coordination(hole);
  CHECK(value_of(found, "rattlers") == Approx(1.0 / 49));
  CHECK(value_of(found, "z_no_rattlers") == Approx(2.0 * (2 * 6 * 7 - 4) / 48));
  CHECK(value_of(found, "z") == Approx(2.0 * (2 * 6 * 7 - 4) / 49));
}

TEST_CASE("the gap of a contact is relative to the smaller sphere") {
  Packing packing = box_of(2, 100);
  add(packing, {20, 20}, 10);
  add(packing, {31 + 1e-4, 20}, 1);
  Metric metric = metric_of(MetricName::coordination);
  metric.contact_gap = 1.1e-4;
  CHECK(measured("z", packing, metric, {}) == 1);
  metric.contact_gap = 0.9e-4;
  CHECK(measured("z", packing, metric, {}) == 0);
}

TEST_CASE("the standard error of z is that of the spheres' numbers: three in a row have 1, 2 and 1 contacts") {
  Packing row = box_of(3, 10);
  for (const double x : {1.0, 3.0, 5.0})
    row.positions.insert(row.positions.end(), {x + 1, 5, 5});
  row.radii = {1, 1, 1};
  const Metric metric = metric_of(MetricName::coordination);
  CHECK(measured("z", row, metric, {}) == Approx(4.0 / 3));
  CHECK(measured("z_se", row, metric, {}) == Approx(std::sqrt(1.0 / 3 / 3))); // sample variance 1/3
}
