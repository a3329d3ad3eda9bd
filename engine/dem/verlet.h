// A step of velocity Verlet over spheres that turn or do not.
#pragma once

#include "engine/base/parallel.h"
#include "engine/dem/force_field.h"

namespace tamp {

/// Half a step of velocities, and of spins where there are any.
template <int D, class Law>
void kick(State<D, Law>& s, double half_dt) {
  parallel_for(s.count(), [&](std::size_t i) {
    s.velocity[i] += half_dt / s.mass[i] * s.force[i];
    if constexpr (Law::turns)
      s.spin[i] += half_dt / (s.gyration * s.mass[i] * s.radius[i] * s.radius[i]) * s.torque[i];
  });
}

/// Kick, drift, new forces, kick (Swope et al., J. Chem. Phys. 76, 637, 1982). Forces that depend on velocities see
/// those of the half step, as in LAMMPS. The forces of the present place must be known: evaluate() once before.
template <int D, class Law>
void verlet_step(State<D, Law>& s, ForceField<D, Law>& field, double dt) {
  kick(s, dt / 2);
  parallel_for(s.count(), [&](std::size_t i) { s.centre[i] += dt * s.velocity[i]; });
  field.evaluate(s, dt);
  kick(s, dt / 2);
}

/// Of the motion of centres and, where spheres turn, of the turning.
template <int D, class Law>
double kinetic_energy(const State<D, Law>& s) {
  return parallel_sum<double>(s.count(), [&](std::size_t i) {
    double energy = s.mass[i] * s.velocity[i].squaredNorm();
    if constexpr (Law::turns) {
      const double inertia = s.gyration * s.mass[i] * s.radius[i] * s.radius[i];
      if constexpr (D == 2)
        energy += inertia * s.spin[i] * s.spin[i];
      else
        energy += inertia * s.spin[i].squaredNorm();
    }
    return 0.5 * energy;
  });
}

} // namespace tamp
