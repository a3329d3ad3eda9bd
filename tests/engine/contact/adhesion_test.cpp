// JKR and DMT: pull-off force, hysteresis, the curve itself, and which of the two a contact calls for.
#include "engine/base/random.h"
#include "engine/contact/tabor.h"
#include "tests/engine/contact/two_bodies.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr double kPi = std::numbers::pi;

/// Forces met while the overlap goes to `deepest` and back until the contact breaks.
struct Cycle {
  double first_force;  ///< at the first touch
  double largest_pull; ///< on the way back
  double breaks_at;    ///< overlap of the last contact
  double work_lost;    ///< ∮F dδ
};

template <class Normal>
Cycle press_and_pull(const Normal& normal, double radius, double deepest, int steps) {
  const ContactLaw<Normal> law{normal};
  typename ContactLaw<Normal>::template History<3> history;
  Cycle cycle{};
  bool met = false;
  const double range = deepest + 2 * normal.reach(radius);
  const double step = range / steps;
  const auto overlap_at = [&](int k) { return deepest - std::abs(k) * step; };
  for (int k = -steps; k <= steps; ++k) {
    const double overlap = overlap_at(k);
    if (!law.template touches<3>(overlap, radius, history))
      continue;
    const double force = normal.at(overlap, radius).force;
    if (!met)
      cycle.first_force = force;
    met = true;
    cycle.work_lost += (k < 0 ? force : k == 0 ? 0 : -force) * step;
    if (k > 0) {
      cycle.largest_pull = std::max(cycle.largest_pull, -force);
      cycle.breaks_at = overlap;
    }
  }
  return cycle;
}

} // namespace

TEST_CASE("JKR pulls off at 3/2 πWR, DMT at 2πWR, and JKR alone loses work", "[adhesion]") {
  const double E = 3e6;
  const double W = 0.7;
  const double R = 0.4;
  constexpr int kSteps = 200000;

  const Jkr jkr{E, W};
  const double deepest = 5 * jkr.reach(R);
  const Cycle j = press_and_pull(jkr, R, deepest, kSteps);
  CHECK(jkr.pull_off(R) == Approx(1.5 * kPi * W * R));
  CHECK(j.largest_pull == Approx(1.5 * kPi * W * R).epsilon(1e-4));
  CHECK(j.first_force == Approx(-4.0 / 3.0 * kPi * W * R).epsilon(1e-3)); // 8/9 of the pull-off
  const double a_c = std::cbrt(9 * kPi * W * R * R / (8 * E));
  CHECK(j.breaks_at == Approx(-a_c * a_c / (3 * R)).epsilon(1e-3));
  // What the loop encloses is the work from the first touch back to the break.
  CHECK(j.work_lost == Approx(jkr.energy(-jkr.reach(R), R)).epsilon(1e-3));

  const Dmt dmt{E, W};
  const Cycle d = press_and_pull(dmt, R, deepest, kSteps);
  CHECK(d.largest_pull == Approx(2 * kPi * W * R).epsilon(1e-4));
  CHECK(d.first_force == Approx(-d.largest_pull).epsilon(1e-4));
  CHECK(std::abs(d.work_lost) < 1e-4 * j.work_lost);
}

TEST_CASE("JKR's contact radius solves its two equations, and its energy is the integral of its force", "[adhesion]") {
  RandomStream random("jkr", 1);
  for (int trial = 0; trial < 200; ++trial) {
    const double E = std::pow(10, 2 + 8 * random.uniform());
    const double R = std::pow(10, -6 + 6 * random.uniform());
    const double W = E * R * std::pow(10, -8 + 5 * random.uniform());
    const Jkr jkr{E, W};
    const double overlap = jkr.reach(R) * (-0.99 + 5 * random.uniform());
    const auto [force, a] = jkr.at(overlap, R);
    CHECK(a * a / R - std::sqrt(2 * kPi * W * a / E) == Approx(overlap).margin(1e-13 * a * a / R));
    CHECK(
        force ==
        Approx(4 * E * a * a * a / (3 * R) - std::sqrt(8 * kPi * W * E * a * a * a)).margin(1e-13 * E * a * a * a / R));
    const double h = 1e-5 * jkr.reach(R);
    CHECK((jkr.energy(overlap + h, R) - jkr.energy(overlap - h, R)) / (2 * h) ==
          Approx(force).margin(1e-4 * jkr.pull_off(R)));
  }
}

TEST_CASE("without adhesion JKR and DMT are Hertz to the last digits", "[adhesion]") {
  for (const double overlap : {1e-9, 1e-5, 1e-2}) {
    const NormalForce hertz = Hertz{1e7}.at(overlap, 0.7);
    CHECK(Jkr{1e7, 0}.at(overlap, 0.7).force == Approx(hertz.force).epsilon(1e-14));
    CHECK(Jkr{1e7, 0}.at(overlap, 0.7).contact_radius == Approx(hertz.contact_radius).epsilon(1e-14));
    CHECK(Dmt{1e7, 0}.at(overlap, 0.7).force == hertz.force);
  }
  CHECK(Jkr{1e7, 0}.at(0, 0.7).force == 0);
}

TEST_CASE("Tabor's parameter calls soft sticky spheres JKR, hard small ones DMT, whatever the unit of length") {
  CHECK(adheres_as_jkr(tabor_parameter(1e6, 0.1, 1e-3, kAttractionRange)));    // rubber balls of a millimetre
  CHECK(!adheres_as_jkr(tabor_parameter(2e11, 0.05, 1e-8, kAttractionRange))); // metal grains of ten nanometres
  // W is energy per area (force per length), so a unit of length 1e6 times smaller takes 1e-12 of E's number, and 1e-6
  // of W's if forces keep theirs.
  CHECK(tabor_parameter(2e11 * 1e-12, 0.05 * 1e-6, 1e-2, kAttractionRange * 1e6) ==
        Approx(tabor_parameter(2e11, 0.05, 1e-8, kAttractionRange)));
  // The threshold is where the pull-off force of the transition is half-way.
  const double lambda = 4.04 * std::pow(1.16 * kTaborThreshold, 1.4);
  CHECK(1.75 - 0.25 * (lambda - 1) / (lambda + 1) == Approx(1.75).epsilon(0.01));
}
