// Torque of a contact against rolling: a spring in the rolling displacement with a limit, or none.
#pragma once

#include "engine/contact/slider.h"
#include "engine/contact/spin.h"

namespace tamp {

struct NoRolling {
  static constexpr bool resists = false;
  template <int D>
  struct Memory {};
};

/// Pseudo-force F_r = −k_r s_r − c_r v_r, |F_r| ≤ μ_r F_crit, of the rolling velocity v_r = R (ω_i − ω_j) × n; its
/// torque is R n × F_r on i and the reverse on j, so that no net force arises (Luding, Granular Matter 10, 235, 2008,
/// section 3.5; objective v_r of Wang, Alonso-Marroquín & Guo, Particuology 23, 49, 2015, eq. 31).
/// LAMMPS: `rolling sds k_r c_r μ_r`.
struct RollingSpring {
  double stiffness; ///< k_r, force per length
  double damping;   ///< c_r, force per velocity
  double friction;  ///< μ_r

  static constexpr bool resists = true;
  template <int D>
  struct Memory {
    Vec<D> roll = Vec<D>::Zero(); ///< s_r
  };

  /// Torque on i; radius: effective. spin: ω_i − ω_j.
  template <int D>
  Spin<D> torque(Memory<D>& memory, const Vec<D>& normal, const Spin<D>& spin, double radius, double critical_force,
                 double dt) const {
    const Vec<D> velocity = radius * cross(spin, normal);
    const Vec<D> force = slide<D>(memory.roll, normal, velocity, stiffness, damping, friction * critical_force, dt);
    return radius * cross(normal, force);
  }
};

} // namespace tamp
