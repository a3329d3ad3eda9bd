// Hertz's normal force between elastic spheres, without adhesion, and the closed forms of a collision under it.
#pragma once

#include <cmath>
#include <numbers>

namespace tamp {

/// What every normal law answers with.
struct NormalForce {
  double force;          ///< repulsive when positive
  double contact_radius; ///< a of the circle of contact
};

/// F = 4/3 E* √R δ^{3/2}, a = √(Rδ) (Hertz 1882; Johnson, Contact Mechanics, 1985, eq. 4.22–4.23).
/// LAMMPS: `pair_style granular`, `hertz/material`.
struct Hertz {
  double modulus; ///< E*

  static constexpr bool adheres = false;
  /// Nothing is remembered of a contact.
  struct Memory {};

  /// At an overlap δ ≥ 0 of spheres of effective radius R.
  [[nodiscard]] NormalForce at(double overlap, double radius) const {
    const double a = std::sqrt(radius * overlap);
    return {4.0 / 3.0 * modulus * a * overlap, a};
  }
  /// ∫₀^δ F dδ = 8/15 E* √R δ^{5/2}.
  [[nodiscard]] double energy(double overlap, double radius) const {
    return 8.0 / 15.0 * modulus * std::sqrt(radius * overlap) * overlap * overlap;
  }
  /// Largest pull that a contact bears.
  [[nodiscard]] static double pull_off(double /*radius*/) { return 0; }
  /// Gap up to which an existing contact holds.
  [[nodiscard]] static double reach(double /*radius*/) { return 0; }
};

/// Largest overlap of two spheres of effective mass m and radius R that meet at speed v without damping:
/// (15 m v²/(16 E* √R))^{2/5} (Johnson 1985, eq. 11.23).
inline double hertz_largest_overlap(double modulus, double radius, double mass, double speed) {
  return std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4);
}

/// Duration of that collision: 2 (δ*/v) ∫₀¹ dx/√(1 − x^{5/2}) = (4√π Γ(2/5)/(5 Γ(9/10))) δ*/v = 2.943 δ*/v, which is
/// 2.87 (m²/(R E*² v))^{1/5} (Johnson 1985, eq. 11.24).
inline double hertz_collision_time(double modulus, double radius, double mass, double speed) {
  const double factor = 0.8 * std::sqrt(std::numbers::pi) * std::tgamma(0.4) / std::tgamma(0.9);
  return factor * hertz_largest_overlap(modulus, radius, mass, speed) / speed;
}

/// E* at which a contact bears a force F at an overlap δ: 3 F/(4 √R δ^{3/2}).
inline double hertz_modulus(double force, double radius, double overlap) {
  return 0.75 * force / (std::sqrt(radius) * std::pow(overlap, 1.5));
}

/// Stiffness 2 E* a of a contact under a force F: 2 (3/4 F R)^{1/3} E*^{2/3} (from the same equations).
inline double hertz_stiffness(double modulus, double radius, double force) {
  return 2 * std::cbrt(0.75 * force * radius * modulus * modulus);
}

} // namespace tamp
