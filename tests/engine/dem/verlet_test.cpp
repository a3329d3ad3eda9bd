// The integrator keeps energy and momentum where the laws do, and moves a lone pair as the closed forms say.
#include "engine/base/random.h"
#include "engine/dem/verlet.h"

#include <catch2/catch.hpp>

using namespace tamp;

namespace {

/// A gas of n elastic spheres in a box periodic on all axes.
template <int D, class Law>
State<D, Law> gas(std::size_t n, double edge, RandomStream& random) {
  std::vector<Vec<D>> centres;
  const auto cells = static_cast<std::size_t>(edge / 2.5);
  for (std::size_t i = 0; i < n; ++i) {
    Vec<D> c;
    std::size_t rest = i;
    for (int a = 0; a < D; ++a) {
      c[a] = 2.5 * (static_cast<double>(rest % cells) + 0.5);
      rest /= cells;
    }
    centres.push_back(c);
  }
  State<D, Law> state = at_rest<D, Law>(centres, std::vector<double>(n, 1.0), std::vector<double>(n, 2.0), 0);
  for (Vec<D>& v : state.velocity) {
    for (int a = 0; a < D; ++a)
      v[a] = 2 * random.uniform() - 1;
  }
  return state;
}

template <int D>
Vec<D> momentum(const auto& state) {
  Vec<D> sum = Vec<D>::Zero();
  for (std::size_t i = 0; i < state.count(); ++i)
    sum += state.mass[i] * state.velocity[i];
  return sum;
}

} // namespace

TEMPLATE_TEST_CASE_SIG("an elastic gas keeps its energy and momentum through hundreds of collisions", "[verlet]",
                       ((int D), D), 2, 3) {
  using Law = ContactLaw<Hertz>;
  RandomStream random("gas", D);
  SearchBox<D> box;
  box.size = Vec<D>::Constant(10.0);
  box.periodic.fill(true);
  State<D, Law> state = gas<D, Law>(D == 2 ? 16 : 64, 10, random);
  ForceField<D, Law> field(Law{{1e3}}, box, 0.3);
  const double dt = hertz_collision_time(1e3, 0.5, 1, 1) / 100;
  field.evaluate(state, dt);
  const double before = kinetic_energy(state);
  const Vec<D> p = momentum<D>(state);
  double worst = 0;
  double deepest_share = 0; // of the energy in contacts: there were collisions
  for (int k = 0; k < 20000; ++k) {
    verlet_step(state, field, dt);
    if (k % 50 == 0) {
      const double stored = field.summary(state).energy;
      deepest_share = std::max(deepest_share, stored / before);
      worst = std::max(worst, std::abs(kinetic_energy(state) + stored - before) / before);
    }
  }
  CHECK(deepest_share > 0.05);
  CHECK(worst < 1e-3);
  CHECK((momentum<D>(state) - p).norm() < 1e-11);
}

TEMPLATE_TEST_CASE_SIG("a ball on the floor bounces to the height that its restitution says", "[verlet]", ((int D), D),
                       2, 3) {
  using Law = ContactLaw<Hertz, TsujiDamping>;
  const double e = 0.6;
  SearchBox<D> box;
  box.size = Vec<D>::Constant(10.0);
  box.wall.fill({true, true});
  Vec<D> start = Vec<D>::Constant(5.0);
  start[vertical<D>] = 3;
  State<D, Law> state = at_rest<D, Law>({start}, {1.0}, {1.0}, 1);
  ForceField<D, Law> field(Law{{1e9}, {damping_of_restitution(e)}}, box, 0.1);
  const double dt = hertz_collision_time(1e9, 1, 1, 2) / 100;
  field.evaluate(state, dt);
  bool rising = false;
  double height = 0;
  for (int k = 0; k < 2000000 && !(rising && state.velocity[0][vertical<D>] < 0); ++k) {
    verlet_step(state, field, dt);
    rising = rising || state.velocity[0][vertical<D>] > 0;
    height = state.centre[0][vertical<D>] - 1;
  }
  CHECK(height == Approx(e * e * 2).epsilon(2e-3));
}
