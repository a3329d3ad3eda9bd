// Hertz's collision against its closed forms, restitution at all speeds, conservation of energy.
#include "tests/engine/contact/two_bodies.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr double kModulus = 1e7;
constexpr int kStepsOfCollision = 4000;

struct Bounce {
  double duration;
  double largest_overlap;
  double restitution;
  double energy_error; ///< largest change of the whole energy, relative to the kinetic energy
};

/// Head-on collision of spheres of radii 1 and 3, masses 2 and 5, closing at `speed`; lengths multiplied by `unit`.
template <int D, class Law>
Bounce collide(const Law& law, double speed, double unit = 1) {
  TwoBodies<D, Law> pair{law, {}, {}, 0};
  pair.i.radius = unit;
  pair.i.mass = 2;
  pair.j.radius = 3 * unit;
  pair.j.mass = 5;
  const double R = effective(pair.i.radius, pair.j.radius);
  const double m = effective(pair.i.mass, pair.j.mass);
  pair.dt = hertz_collision_time(law.normal.modulus, R, m, speed) / kStepsOfCollision;
  pair.i.position = 4 * unit * Vec<D>::Constant(1 / std::sqrt(D));
  const Vec<D> towards = -pair.i.position.normalized();
  pair.i.velocity = speed * towards;

  Bounce bounce{};
  const double before = 0.5 * m * speed * speed;
  double closing = speed;
  do {
    pair.step();
    closing = (pair.i.velocity - pair.j.velocity).dot(towards);
    bounce.duration += pair.dt;
    bounce.largest_overlap = std::max(bounce.largest_overlap, pair.loads.overlap);
    const double stored = law.normal.energy(std::max(0.0, pair.loads.overlap), R);
    bounce.energy_error =
        std::max(bounce.energy_error, std::abs(0.5 * m * closing * closing + stored - before) / before);
  } while (pair.loads.overlap > 0);
  bounce.restitution = -closing / speed;
  return bounce;
}

} // namespace

TEST_CASE("a Hertz collision lasts as long, goes as deep and keeps as much energy as the closed forms say", "[hertz]") {
  const ContactLaw<Hertz> law{{kModulus}};
  const double R = effective(1.0, 3.0);
  const double m = effective(2.0, 5.0);
  for (const double speed : {0.01, 1.0, 20.0}) {
    for (const Bounce& b : {collide<2>(law, speed), collide<3>(law, speed)}) {
      CHECK(b.duration == Approx(hertz_collision_time(kModulus, R, m, speed)).epsilon(1e-3));
      CHECK(b.largest_overlap == Approx(hertz_largest_overlap(kModulus, R, m, speed)).epsilon(1e-5));
      CHECK(b.restitution == Approx(1).epsilon(1e-5));
      CHECK(b.energy_error < 1e-5);
    }
  }
  // The constant as textbooks print it.
  CHECK(hertz_collision_time(1, 1, 1, 1) == Approx(2.87).epsilon(1e-3));
}

TEST_CASE("the restitution is the stated one at every speed, in every unit of length", "[damping]") {
  for (const double e : {0.1, 0.3, 0.5, 0.8, 0.95, 1.0}) {
    const double alpha = damping_of_restitution(e);
    CHECK(restitution_of_damping(alpha) == Approx(e).epsilon(1e-12));
    const ContactLaw<Hertz, TsujiDamping> law{{kModulus}, {alpha}};
    for (const double speed : {0.001, 0.1, 10.0}) {
      INFO("restitution " << e << ", speed " << speed);
      CHECK(collide<3>(law, speed).restitution == Approx(e).epsilon(2e-3));
      CHECK(collide<2>(law, speed).restitution == Approx(e).epsilon(2e-3));
    }
    // Lengths in units a million times smaller: modulus (force per area, mass and time kept) scales with 1/length.
    const ContactLaw<Hertz, TsujiDamping> scaled{{kModulus * 1e-6}, {alpha}};
    CHECK(collide<3>(scaled, 0.1 * 1e6, 1e6).restitution == Approx(collide<3>(law, 0.1).restitution).epsilon(1e-9));
  }
}

TEST_CASE("LAMMPS is told the restitution that gives its polynomial our damping", "[damping]") {
  for (const double e : {0.3, 0.5, 0.8, 0.9}) {
    const double alpha = damping_of_restitution(e);
    CHECK(lammps_damping(lammps_restitution(alpha)) == Approx(alpha).epsilon(1e-12));
    // The polynomial is Tsuji's fit to the same relation, with another mass: √2 times it is α to the fit's accuracy.
    CHECK(std::sqrt(2.0) * lammps_damping(e) == Approx(alpha).epsilon(0.02));
  }
}
