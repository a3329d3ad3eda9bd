// Tangential force of a contact: Mindlin's spring with Coulomb's limit, or none.
#pragma once

#include "engine/contact/slider.h"

namespace tamp {

/// Spheres that feel no friction do not turn, and contacts remember nothing.
struct NoFriction {
  static constexpr bool turns = false;
  template <int D>
  struct Memory {};
};

/// F_t = −8 G* a s − γ_t η v_t, |F_t| ≤ μ F_crit: Mindlin's no-slip stiffness (J. Appl. Mech. 16, 259, 1949) on the
/// tangential displacement s since the contact began. η is the coefficient of the normal damping.
/// LAMMPS: `tangential mindlin NULL γ_t μ`.
struct Mindlin {
  double shear_modulus; ///< G*
  double friction;      ///< Coulomb's μ
  double damping_ratio; ///< γ_t

  static constexpr bool turns = true;
  template <int D>
  struct Memory {
    Vec<D> slip = Vec<D>::Zero(); ///< s, from the view of sphere i
  };

  /// a: radius of the contact, above 0; velocity: of i relative to j, at the contact, in the tangent plane.
  template <int D>
  Vec<D> force(Memory<D>& memory, const Vec<D>& normal, const Vec<D>& velocity, double contact_radius,
               double normal_damping, double critical_force, double dt) const {
    return slide<D>(memory.slip, normal, velocity, 8 * shear_modulus * contact_radius, damping_ratio * normal_damping,
                    friction * critical_force, dt);
  }
};

} // namespace tamp
