// A step of velocity Verlet over spheres that turn or do not.
#pragma once

#include "engine/base/parallel.h"
#include "engine/dem/force_field.h"

#include <cmath>

namespace tamp {

/// Motion under the forces alone.
struct Undamped {
  template <class V>
  const V& operator()(const V& force, const V& /*velocity*/) const {
    return force;
  }
};

/// A force against the motion of a sphere, as large as this share of the net force on it (Cundall, Int. J. Rock Mech.
/// Min. Sci. Geomech. Abstr. 24, 395, 1987; here along the velocity instead of axis by axis): every mode loses the same
/// share of its energy in a swing, fast or slow, and nothing is damped where forces balance.
struct LocalDamping {
  double share; ///< from 0 to below 1

  template <class V>
  V operator()(const V& force, const V& velocity) const {
    const double speed = size(velocity);
    return speed > 0 ? V(force - share * size(force) / speed * velocity) : force;
  }

private:
  static double size(double number) { return std::abs(number); }
  template <int D>
  static double size(const Eigen::Matrix<double, D, 1>& v) {
    return v.norm();
  }
};

/// Half a step of velocities, and of spins where there are any.
template <int D, class Law, class Damping>
void kick(State<D, Law>& s, double half_dt, const Damping& damping) {
  parallel_for(s.count(), [&](std::size_t i) {
    const double per_mass = half_dt / s.mass[i];
    s.velocity[i] += per_mass * damping(s.force[i], s.velocity[i]);
    if constexpr (Law::turns)
      s.spin[i] += per_mass / (s.gyration * s.radius[i] * s.radius[i]) * damping(s.torque[i], s.spin[i]);
  });
}

/// Kick, drift, new forces, kick (Swope et al., J. Chem. Phys. 76, 637, 1982). Forces that depend on velocities see
/// those of the half step, as in LAMMPS. The forces of the present place must be known: evaluate() once before.
template <int D, class Law, class LoadKind, class Damping = Undamped>
void verlet_step(State<D, Law>& s, ForceField<D, Law, LoadKind>& field, double dt, const Damping& damping = {}) {
  kick(s, dt / 2, damping);
  parallel_for(s.count(), [&](std::size_t i) { s.centre[i] += dt * s.velocity[i]; });
  field.evaluate(s, dt);
  kick(s, dt / 2, damping);
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
