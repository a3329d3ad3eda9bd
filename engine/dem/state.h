// The moving spheres: one array per quantity; what a contact law does not call for has no array.
#pragma once

#include "engine/base/vec.h"
#include "engine/contact/spin.h"

#include <type_traits>
#include <vector>

namespace tamp {

/// Spins and torques of spheres that turn.
template <int D, bool turns>
struct Rotation {
  std::vector<Spin<D>> spin;           ///< angular velocities
  std::vector<Spin<D>> torque;         ///< about the centres
  double gyration = tamp::gyration<D>; ///< moment of inertia divided by m r²
};
/// Spheres that do not turn.
template <int D>
struct Rotation<D, false> {};

/// n spheres. Any consistent units.
template <int D, class Law>
struct State : Rotation<D, Law::turns> {
  std::vector<Vec<D>> centre;
  std::vector<Vec<D>> velocity;
  std::vector<Vec<D>> force;
  std::vector<double> radius;
  std::vector<double> mass;   ///< inertia
  std::vector<double> weight; ///< the force of gravity, along −e_vertical

  [[nodiscard]] std::size_t count() const { return radius.size(); }
};

/// Spheres at rest under `gravity` along −e_vertical.
template <int D, class Law>
State<D, Law> at_rest(const std::vector<Vec<D>>& centres, const std::vector<double>& radii,
                      const std::vector<double>& masses, double gravity) {
  State<D, Law> state;
  const std::size_t n = radii.size();
  state.velocity.assign(n, Vec<D>::Zero());
  state.force.assign(n, Vec<D>::Zero());
  if constexpr (Law::turns) {
    state.spin.assign(n, zero_spin<D>());
    state.torque.assign(n, zero_spin<D>());
  }
  state.centre = centres;
  state.radius = radii;
  state.mass = masses;
  for (const double m : masses)
    state.weight.push_back(m * gravity);
  return state;
}

/// What contacts remember, one entry per near pair or wall; nothing if the law needs no memory.
template <int D, class Law, bool remembers = !std::is_empty_v<typename Law::template History<D>>>
struct Memories {
  std::vector<typename Law::template History<D>> of_pair;
  std::vector<typename Law::template History<D>> of_wall;
};
template <int D, class Law>
struct Memories<D, Law, false> {};

} // namespace tamp
