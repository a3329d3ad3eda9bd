// Local damping by its closed form; matched inertia keeps energies and the step stable; fines fall like the others.
#include "engine/dem/scaled_inertia.h"
#include "engine/dem/verlet.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace tamp;

namespace {

using Law = ContactLaw<Hertz, TsujiDamping, Mindlin>;
constexpr double kModulus = 1e4;

Law law() {
  const Elastic solid{2 * (1 - 0.3 * 0.3) * kModulus, 0.3};
  return {{kModulus}, {damping_of_restitution(0.8)}, {effective_shear_modulus(solid, solid), 0.5, 1}};
}

/// A tower of spheres of these radii on the floor, overlapping a little, each moving and turning.
State<3, Law> tower(const std::vector<double>& radii) {
  std::vector<Vec<3>> centres;
  std::vector<double> masses;
  double top = 0;
  for (const double r : radii) {
    top += 0.999 * r;
    centres.emplace_back(2, 2, top);
    top += 0.999 * r;
    masses.push_back(4.0 / 3.0 * std::numbers::pi * r * r * r);
  }
  State<3, Law> s = at_rest<3, Law>(centres, radii, masses, 1);
  for (std::size_t i = 0; i < s.count(); ++i) {
    s.velocity[i] = Vec<3>(0, 0, 1e-3 * (i % 2 == 0 ? 1 : -1));
    s.spin[i] = Vec<3>(1e-3, 0, 0);
  }
  return s;
}

ForceField<3, Law> field_of(State<3, Law>& s) {
  SearchBox<3> box;
  box.size = Vec<3>(4, 4, 100);
  box.wall[2] = {true, false};
  ForceField<3, Law> field(law(), box, 0.1);
  field.evaluate(s, 0);
  return field;
}

} // namespace

TEST_CASE("local damping takes its share of the force against the motion") {
  const LocalDamping damping{0.25};
  const Vec<3> f(0, 3, 4);
  CHECK(damping(f, Vec<3>(Vec<3>::Zero())) == f);
  CHECK((damping(f, Vec<3>(0, 6, 8)) - 0.75 * f).norm() < 1e-14);
  CHECK((damping(f, Vec<3>(-f)) - 1.25 * f).norm() < 1e-14);
  CHECK((damping(f, Vec<3>(2, 0, 0)) - (f - Vec<3>(1.25, 0, 0))).norm() < 1e-14);
  CHECK(damping(-2.0, 7.0) == -2.5);
}

TEST_CASE("matched inertia changes no kinetic energy") {
  State<3, Law> s = tower({1, 0.05, 1, 0.3});
  const ForceField<3, Law> field = field_of(s);
  const double before = kinetic_energy(s);
  match_inertia(s, field, 1e-3, [&](std::size_t i) { return s.weight[i]; });
  CHECK(kinetic_energy(s) == Approx(before).epsilon(1e-12));
}

TEST_CASE("with matched inertia one step is stable for spheres of every size, with less it is not") {
  const double dt = 0.01;
  for (const double share : {1.0, 1.0 / 16}) {
    State<3, Law> s = tower({1, 0.05, 1, 0.02, 0.5});
    std::fill(s.weight.begin(), s.weight.end(), 0.0);
    ForceField<3, Law> field = field_of(s);
    match_inertia(s, field, dt, [&](std::size_t i) { return s.weight[i]; });
    for (double& mass : s.mass)
      mass *= share;
    const double energy = kinetic_energy(s) + field.summary(s).energy;
    for (int k = 0; k < 200; ++k)
      verlet_step(s, field, dt);
    CHECK((kinetic_energy(s) + field.summary(s).energy < 1.5 * energy) == (share == 1.0));
  }
}

TEST_CASE("fines are made denser up to the median's period, and fall as fast as all") {
  State<3, Law> s = tower({0.1, 0.2, 1, 2, 3});
  const std::vector<double> masses = s.mass;
  make_fines_denser(s);
  for (std::size_t i = 0; i < s.count(); ++i) {
    CHECK(s.weight[i] == Approx(s.mass[i]));
    CHECK(s.mass[i] / masses[i] == Approx(std::max(1.0, 1 / (s.radius[i] * s.radius[i]))));
  }
  CHECK(s.mass[0] / s.radius[0] == Approx(s.mass[2] / s.radius[2]));
}

TEST_CASE("spheres in the air are set down on what lies below them, and those that lie stay") {
  State<3, Law> s = tower({1, 1, 0.5});
  const double top = s.centre[2][2];
  ForceField<3, Law> field = field_of(s);
  CHECK_FALSE(floats(s, 0));
  CHECK_FALSE(floats(s, 2));
  // One above the tower, one far beside it above the floor, one above the first: it must land on that, not in it.
  s = tower({1, 1, 0.5, 0.3, 0.4, 0.2});
  s.centre[3] = Vec<3>(2.3, 2, top + 7);
  s.centre[4] = Vec<3>(3.9, 0.1, 5); // periodic images of a walled box do not count
  s.centre[5] = Vec<3>(2.3, 2, top + 20);
  field.evaluate(s, 0);
  const std::vector<Vec<3>> before = s.centre;
  land_floating(s, field.box());
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(s.centre[i] == before[i]);
  CHECK(s.centre[3][2] == Approx(top + std::sqrt(0.8 * 0.8 - 0.3 * 0.3)));
  CHECK(s.centre[4][2] == Approx(0.4));
  CHECK(s.centre[5][2] == Approx(s.centre[3][2] + 0.5));
  for (std::size_t i = 3; i < 6; ++i)
    CHECK(s.velocity[i].isZero(0));
  CHECK_FALSE(s.velocity[0].isZero(0));
}

TEST_CASE("a sphere in the air lands on the periodic image of another") {
  State<3, Law> s = tower({1, 0.5});
  s.centre[0] = Vec<3>(0.2, 2, 0.999);
  s.centre[1] = Vec<3>(3.9, 2, 30);
  SearchBox<3> box;
  box.size = Vec<3>(4, 4, 100);
  box.periodic = {true, true, false};
  box.wall[2] = {true, false};
  ForceField<3, Law> field(law(), box, 0.1);
  field.evaluate(s, 0);
  land_floating(s, box);
  CHECK(s.centre[1][2] == Approx(0.999 + std::sqrt(1.5 * 1.5 - 0.3 * 0.3)));
}
