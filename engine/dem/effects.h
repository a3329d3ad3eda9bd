// The contact effects that a scene calls for, and the contact law that is put together from them.
#pragma once

#include "engine/contact/contact_law.h"
#include "engine/contact/material.h"

namespace tamp {

enum class AdhesionLaw { none, dmt, jkr };

/// Which effects a scene calls for. Elastic contacts are always there; without friction and adhesion the
/// energy is minimised and there is no motion to damp.
struct ContactEffects {
  AdhesionLaw adhesion = AdhesionLaw::none;
  bool friction = false; ///< with it: rotation and the memory of every contact

  friend bool operator==(const ContactEffects&, const ContactEffects&) = default;
};

/// The numbers of both bodies of every contact, in any consistent units.
struct ContactNumbers {
  double poisson = 0.3;
  double friction = 0;    ///< Coulomb's μ
  double restitution = 1; ///< e; of no account without damping
  double adhesion = 0;    ///< W
};

/// The contact law at the stiffness E*.
template <class Normal, class Damping, class Friction>
ContactLaw<Normal, Damping, Friction> contact_law(const ContactNumbers& numbers, double modulus) {
  ContactLaw<Normal, Damping, Friction> law{};
  law.normal.modulus = modulus;
  if constexpr (Normal::adheres)
    law.normal.adhesion = numbers.adhesion;
  if constexpr (Damping::damps)
    law.damping = {damping_of_restitution(numbers.restitution)};
  if constexpr (Friction::turns) {
    // Two bodies of one material: E* = E/(2(1 − ν²)), so G* follows from E* and ν.
    const Elastic solid{2 * (1 - numbers.poisson * numbers.poisson) * modulus, numbers.poisson};
    law.friction = {effective_shear_modulus(solid, solid), numbers.friction, 1};
  }
  return law;
}

} // namespace tamp
