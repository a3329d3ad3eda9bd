// The event equation of arcs against a fine march along the same arc.
#include "engine/base/random.h"
#include "engine/generate/drop_and_roll/arc.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace tamp;

namespace {

/// First t where f falls below zero, by marching; infinity for none before t_end.
double march(const Sinusoid& f, double t_end) {
  constexpr int steps = 200000;
  double before = f.a + f.b;
  for (int i = 1; i <= steps; ++i) {
    const double t = t_end * i / steps;
    const double now = f.a + f.b * std::cos(t) + f.c * std::sin(t);
    if (before >= 0 && now < 0)
      return t;
    before = now;
  }
  return std::numeric_limits<double>::infinity();
}

} // namespace

TEST_CASE("entering() finds the first descent through zero that a fine march finds") {
  RandomStream random("arc", 1);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    Sinusoid f{2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1};
    if (f.a + f.b < 0)
      f = {-f.a, -f.b, f.c};
    const double t_end = std::numbers::pi * random.uniform();
    const ArcPoint end = ArcPoint::towards(std::cos(t_end), std::sin(t_end));
    ArcPoint where;
    const double u = entering(f, 1e-12, end, where);
    const double t = march(f, t_end);
    INFO("f = " << f.a << " + " << f.b << " cos + " << f.c << " sin up to " << t_end);
    if (std::isinf(t)) {
      CHECK(std::isinf(u));
    } else {
      ++hits;
      REQUIRE(std::isfinite(u));
      CHECK(2 * std::atan(u) == Approx(t).margin(1e-4));
      CHECK(f.at(where) == Approx(0).margin(1e-14));
    }
  }
  CHECK(hits > 50);
}

TEST_CASE("a graze no deeper than the tolerance is no contact, a deeper one is") {
  const ArcPoint end = ArcPoint::half_turn();
  ArcPoint where;
  // minimum −1e-9 at a quarter turn
  const Sinusoid f{1 - 1e-9, 0, -1};
  CHECK(std::isinf(entering(f, 2e-9, end, where)));
  CHECK(std::isfinite(entering(f, 1e-10, end, where)));
}

TEST_CASE("a touching constraint stops an arc that heads into it, and lets one go that leaves it") {
  const ArcPoint end = ArcPoint::half_turn();
  ArcPoint where;
  CHECK(entering({1, -1, -1}, 1e-12, end, where) == 0);         // f(0) = 0, falling
  CHECK(entering({1, -1 - 1e-15, -1}, 1e-12, end, where) == 0); // already below by rounding, falling
  CHECK(std::isinf(entering({2, -2, 1}, 1e-12, end, where)));   // f(0) = 0, rising, back only after half a turn
  CHECK(entering({1, -1, 1}, 1e-12, end, where) > 1e6);         // back at half a turn exactly, or just not
}
