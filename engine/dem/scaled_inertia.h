// Inertia that lets all spheres of a bed move with one long step, where inertia decides nothing but the time it takes.
#pragma once

#include "engine/dem/force_field.h"
#include "engine/dem/land.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp {

/// Of the smallest inertia that keeps a step stable by Gershgorin's bound: dt² Σk/2 on a sphere whose contacts have the
/// stiffnesses k. Contacts become stiffer, and new ones are made, until inertia is matched again.
inline constexpr double kInertiaMargin = 2;
/// A sphere has at least this share of the stiffness that one of its radius has on average, and at least that of so
/// many contacts under the load it must expect: its contacts may be to come.
inline constexpr double kLeastStiffness = 0.25;
inline constexpr double kLeastContacts = 4;
/// Moment of inertia divided by m r² of spheres with matched inertia: more than any real body's, as sliding sees it.
inline constexpr double kMatchedGyration = 1;

/// Share of its motion that a sphere without contacts loses whenever motion is slowed down: one that is squeezed out
/// of its place flies some forty times further than its overlap was deep, not into the blue.
inline constexpr double kFloatSlowing = 0.5;

/// Makes spheres below the median radius denser by (r_median/r)², so that their steps may be as long as the median
/// sphere's: a contact's stiffness goes with r, so its period with √(m/r) (density scaling as in quasi-static models:
/// Thornton & Antony, Powder Technol. 109, 179, 2000). Weight goes along, so that all fall alike.
template <int D, class Law>
void make_fines_denser(State<D, Law>& s) {
  std::vector<double> radii = s.radius;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  for (std::size_t i = 0; i < s.count(); ++i) {
    const double denser = std::max(1.0, *middle * *middle / (s.radius[i] * s.radius[i]));
    s.mass[i] *= denser;
    s.weight[i] *= denser;
  }
}

/// Gives each sphere the inertia that the step `dt` asks for at the present stiffness of its contacts (dynamic
/// relaxation: Underwood, in Computational Methods for Transient Analysis, 1983, p. 245). Kinetic energies stay.
/// load(i): the force that contacts of sphere i must be expected to bear.
template <int D, class Law, class LoadKind, class LoadOf>
void match_inertia(State<D, Law>& s, const ForceField<D, Law, LoadKind>& field, double dt, LoadOf&& load) {
  const std::vector<double> stiffness = field.stiffness(s, kMatchedGyration);
  double sum = 0;
  double radii = 0;
  for (std::size_t i = 0; i < s.count(); ++i) {
    sum += stiffness[i];
    radii += s.radius[i];
  }
  for (std::size_t i = 0; i < s.count(); ++i) {
    const double r = s.radius[i];
    const double least =
        std::max(kLeastStiffness * sum / radii * r,
                 kLeastContacts * hertz_stiffness(field.law().normal.modulus, effective(r, r), load(i)));
    const double inertia = kInertiaMargin * 0.5 * dt * dt * std::max(stiffness[i], least);
    s.velocity[i] *= std::sqrt(s.mass[i] / inertia);
    if constexpr (Law::turns)
      s.spin[i] *= std::sqrt(s.gyration * s.mass[i] / (kMatchedGyration * inertia));
    s.mass[i] = inertia;
  }
  if constexpr (Law::turns)
    s.gyration = kMatchedGyration;
}

/// Takes a share of all velocities and spins, and another one from spheres that touch nothing: what nothing pulls is
/// not damped by its net force.
template <int D, class Law>
void slow_down(State<D, Law>& s, double share, double share_of_floating) {
  for (std::size_t i = 0; i < s.count(); ++i) {
    const double kept = 1 - (floats(s, i) ? share_of_floating : share);
    s.velocity[i] *= kept;
    if constexpr (Law::turns)
      s.spin[i] *= kept;
  }
}

} // namespace tamp
