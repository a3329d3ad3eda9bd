// Settling spheres under gravity: what to settle, by which contact effects, and what came of it.
#pragma once

#include "engine/base/vec.h"
#include "engine/contact/material.h"
#include "engine/dem/effects.h"
#include "engine/search/contact_search.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tamp {

/// A settling task in any consistent units.
template <int D>
struct SettleTask {
  SearchBox<D> box; ///< walls where spheres are held; an open top has none
  std::vector<Vec<D>> centres;
  std::vector<double> radii;
  std::vector<double> masses;
  double gyration = 0; ///< moment of inertia divided by m r²; 0: a disc's in 2D, a sphere's in 3D
  double gravity = 1;  ///< along −e_vertical, above 0

  ContactEffects effects;
  double modulus = 0;         ///< E* to start with
  double largest_modulus = 0; ///< contacts are stiffened up to this where they overlap too much
  double poisson = 0.3;       ///< of both bodies of a contact
  double friction = 0;        ///< Coulomb's μ
  double restitution = 0.5;   ///< e, below 1
  double adhesion = 0;        ///< W

  double overlap = 1e-3;          ///< largest overlap tolerated at the end, relative to the smaller radius
  double force_balance = 1e-3;    ///< rms net force of a sphere, in mean contact forces, at which the bed rests
  double kinetic_energy = 1e-6;   ///< mean per sphere in units of its weight times the mean radius; not for minimising
  double steps_per_collision = 0; ///< 0: kStepsPerCollision
  double longest = 300;           ///< give up after this many times of a free fall from the highest sphere's place
  bool minimise = true;           ///< minimise if there is neither friction nor adhesion

  std::filesystem::path checkpoint = {};                ///< file to keep the state in and to go on from; empty: none
  double checkpoint_every_s = 60;                       ///< wall-clock seconds
  std::function<void(double settled_share)> progress{}; ///< called now and then
};

template <int D>
struct Settled {
  std::vector<Vec<D>> centres; ///< not wrapped into the box
  bool at_rest = false;        ///< else the time was up, or no step was short enough
  double modulus = 0;          ///< E* at the end
  double overlap = 0;          ///< largest, relative to the smaller radius
  double force_balance = 0;
  double kinetic_energy = 0;
  double step = 0;                ///< dt at the end
  std::int64_t steps = 0;         ///< force evaluations
  std::int64_t halvings = 0;      ///< steps found unstable, halved, and redone from the last good state
  std::int64_t stiffenings = 0;   ///< times the contacts were made stiffer
  std::int64_t list_rebuilds = 0; ///< of the near list
};

/// The table's kernel for the task's effects. The result has the same bits on any number of threads, and however often
/// it was cut off and taken up again from its checkpoint.
template <int D>
Settled<D> settle(const SettleTask<D>& task);

extern template Settled<2> settle(const SettleTask<2>&);
extern template Settled<3> settle(const SettleTask<3>&);

} // namespace tamp
