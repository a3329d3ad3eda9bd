// Friction and rolling: the slope, rolling without slipping, conservation of momenta, what the history remembers.
#include "engine/base/random.h"
#include "tests/engine/contact/two_bodies.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr Elastic kMaterial{1e7, 0.3};

template <class Rolling = NoRolling>
ContactLaw<Hertz, TsujiDamping, Mindlin, Rolling> frictional(double mu, double restitution = 0.5,
                                                             Rolling rolling = {}) {
  return {{effective_modulus(kMaterial, kMaterial)},
          {damping_of_restitution(restitution)},
          {effective_shear_modulus(kMaterial, kMaterial), mu, 1},
          rolling};
}

template <int D>
Vec<D> random_vec(RandomStream& random) {
  Vec<D> v;
  for (int a = 0; a < D; ++a)
    v[a] = 2 * random.uniform() - 1;
  return v;
}

template <int D>
Spin<D> random_spin(RandomStream& random) {
  if constexpr (D == 2)
    return 2 * random.uniform() - 1;
  else
    return random_vec<3>(random);
}

/// A sphere that cannot turn, put on a slope of tan θ = steepness: once the jolt of its weight has died away, its
/// acceleration in units of a frictionless slide's.
template <int D>
double downhill(double mu, double steepness) {
  constexpr int kSteps = 50000;
  const double g = 10;
  const double theta = std::atan(steepness);
  Vec<D> gravity = Vec<D>::Zero();
  gravity[0] = g * std::sin(theta);
  gravity[vertical<D>] = -g * std::cos(theta);
  OnWall<D, decltype(frictional(mu))> sphere{frictional(mu), {}, gravity, 2e-5};
  sphere.i.may_turn = false;
  // It starts where its weight is borne.
  const double modulus = sphere.law.normal.modulus;
  const double overlap = std::pow(0.75 * g * std::cos(theta) / modulus, 2.0 / 3.0);
  sphere.i.position[vertical<D>] = sphere.i.radius - overlap;
  for (int k = 0; k < kSteps / 2; ++k)
    sphere.step();
  const double speed = sphere.i.velocity[0];
  for (int k = 0; k < kSteps / 2; ++k)
    sphere.step();
  return (sphere.i.velocity[0] - speed) / (0.5 * kSteps * sphere.dt * g * std::sin(theta));
}

template <int D>
void check_conservation(std::uint64_t seed) {
  RandomStream random("conservation", seed);
  const auto law = frictional(0.4, 0.7, RollingSpring{1e5, 10, 0.1});
  TwoBodies<D, decltype(law)> pair{law, {}, {}, 1e-5};
  pair.i.radius = 0.5 + random.uniform();
  pair.j.radius = 0.5 + random.uniform();
  pair.i.mass = 0.5 + random.uniform();
  pair.j.mass = 0.5 + random.uniform();
  const Vec<D> direction = random_vec<D>(random).normalized();
  pair.i.position = (pair.i.radius + pair.j.radius) * direction;
  pair.i.velocity = -2 * direction + random_vec<D>(random);
  pair.j.velocity = random_vec<D>(random) * 0.3;
  pair.i.spin = 3 * random_spin<D>(random);
  pair.j.spin = 3 * random_spin<D>(random);
  const auto momentum = [&] { return Vec<D>(pair.i.mass * pair.i.velocity + pair.j.mass * pair.j.velocity); };
  const auto angular = [&]() -> Spin<D> {
    const auto of = [](const Body<D>& b) -> Spin<D> {
      return cross(b.position, Vec<D>(b.mass * b.velocity)) + b.inertia() * b.spin;
    };
    return of(pair.i) + of(pair.j);
  };
  const Vec<D> p = momentum();
  const Spin<D> L = angular();
  const Vec<D> before = pair.i.velocity;
  int steps = 0;
  do {
    pair.step();
    ++steps;
  } while (pair.loads.overlap > 0);
  REQUIRE(steps > 50);
  REQUIRE((pair.i.velocity - before).norm() > 0.1);
  CHECK((momentum() - p).norm() < 1e-12);
  if constexpr (D == 2)
    CHECK(std::abs(angular() - L) < 1e-12);
  else
    CHECK((angular() - L).norm() < 1e-12);
}

} // namespace

TEST_CASE("a block stays on a slope below μ and slides as it should above", "[friction]") {
  const double mu = 0.4;
  CHECK(std::abs(downhill<2>(mu, 0.99 * mu)) < 1e-4);
  CHECK(std::abs(downhill<3>(mu, 0.99 * mu)) < 1e-4);
  // Beyond μ it slides with g (sin θ − μ cos θ).
  for (const double steepness : {1.02 * mu, 1.5 * mu}) {
    CHECK(downhill<2>(mu, steepness) == Approx(1 - mu / steepness).margin(1e-4));
    CHECK(downhill<3>(mu, steepness) == Approx(1 - mu / steepness).margin(1e-4));
  }
}

TEMPLATE_TEST_CASE_SIG("a sliding ball ends up rolling without slipping, at 5/7 of its speed (disc: 2/3)", "[friction]",
                       ((int D), D), 2, 3) {
  Vec<D> gravity = Vec<D>::Zero();
  gravity[vertical<D>] = -10;
  OnWall<D, decltype(frictional(0.3))> ball{frictional(0.3), {}, gravity, 2e-5};
  const double overlap = std::pow(7.5 / ball.law.normal.modulus, 2.0 / 3.0);
  ball.i.position[vertical<D>] = ball.i.radius - overlap;
  ball.i.velocity[0] = 1;
  for (int k = 0; k < 50000; ++k)
    ball.step();
  CHECK(ball.i.velocity[0] == Approx(1 / (1 + gyration<D>)).epsilon(1e-3));
  // The lowest point is at rest.
  const Vec<D> down = -Vec<D>::Unit(vertical<D>);
  CHECK((ball.i.velocity + cross(ball.i.spin, down)).norm() < 1e-3);
}

TEST_CASE("momentum and angular momentum survive oblique, spinning, damped, slipping collisions", "[friction]") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    check_conservation<2>(seed);
    check_conservation<3>(seed);
  }
}

TEST_CASE("rolling resistance brings a rolling ball to rest, which rolls on without", "[friction]") {
  const auto speed_after = [](const auto& law) {
    OnWall<3, std::remove_cvref_t<decltype(law)>> ball{law, {}, {0, 0, -10}, 2e-5};
    ball.i.position[2] = ball.i.radius - std::pow(7.5 / law.normal.modulus, 2.0 / 3.0);
    ball.i.velocity[0] = 0.2;
    ball.i.spin = {0, 0.2, 0};
    for (int k = 0; k < 50000; ++k)
      ball.step();
    return std::abs(ball.i.velocity[0]);
  };
  CHECK(speed_after(frictional(0.5)) == Approx(0.2).epsilon(1e-3));
  CHECK(speed_after(frictional(0.5, 0.5, RollingSpring{2e4, 100, 0.05})) < 1e-3);
}

TEST_CASE("a tangential spring follows the turning contact, keeps its length and never exceeds its limit", "[slider]") {
  RandomStream random("slider", 1);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec<3> normal = random_vec<3>(random).normalized();
    Vec<3> stretch = random_vec<3>(random);
    stretch -= stretch.dot(normal) * normal;
    const double length = stretch.norm();
    const Vec<3> turned = (normal + 0.3 * random_vec<3>(random)).normalized();
    slide<3>(stretch, turned, Vec<3>::Zero(), 2, 1, 10 * length, 0.1);
    CHECK(std::abs(stretch.dot(turned)) < 1e-12);
    CHECK(stretch.norm() == Approx(length));

    Vec<3> velocity = random_vec<3>(random);
    velocity -= velocity.dot(turned) * turned;
    const Vec<3> force = slide<3>(stretch, turned, velocity, 2, 1, 0.1 * length, 0.1);
    CHECK(force.norm() <= 0.1 * length * (1 + 1e-12));
    // Where it slips the spring keeps what gives the limit, so that it answers at once when the motion turns back.
    CHECK((force + 2 * stretch + velocity).norm() < 1e-12);
  }
}
