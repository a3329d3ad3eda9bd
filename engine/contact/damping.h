// Viscous damping of the normal motion that gives a stated coefficient of restitution at every speed.
#pragma once

#include <cmath>
#include <numbers>

namespace tamp {

struct NoDamping {
  static constexpr bool damps = false;
  [[nodiscard]] static double coefficient(double /*modulus*/, double /*contact_radius*/, double /*mass*/) { return 0; }
};

/// F = −η v with η = α √(m k_n), k_n = 4/3 E* a; for Hertz's contact η = α √(m 4/3 E* √R) δ^{1/4} (Tsuji, Tanaka &
/// Ishida, Powder Technol. 71, 239, 1992). Late in a collision the force may pull; the exact α counts on that.
/// LAMMPS: `damping tsuji`, whose α comes from another relation: see lammps_restitution.
struct TsujiDamping {
  double alpha;

  static constexpr bool damps = true;
  [[nodiscard]] double coefficient(double modulus, double contact_radius, double mass) const {
    return alpha * std::sqrt(mass * (4.0 / 3.0 * modulus * contact_radius));
  }
};

/// α = −√5 ln e/√(ln²e + π²): exact for Hertz's contact at every speed, as δ^{5/4} maps the motion on that of a
/// linear damped spring (Antypov & Elliott, EPL 94, 50004, 2011, eq. 17). 0 < e ≤ 1.
inline double damping_of_restitution(double restitution) {
  const double log_e = std::log(restitution);
  return -std::sqrt(5.0) * log_e / std::hypot(log_e, std::numbers::pi);
}

/// The reverse relation: e = exp(−π α/√(5 − α²)), 0 ≤ α < √5.
inline double restitution_of_damping(double alpha) {
  return std::exp(-std::numbers::pi * alpha / std::sqrt(5 - alpha * alpha));
}

/// α of LAMMPS for the restitution it is told: Tsuji's polynomial, made for the mass of one of two equal spheres but
/// used there with the effective mass, so that α is smaller by √2 and spheres bounce more than they are told to.
inline double lammps_damping(double e) {
  return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
}

/// What LAMMPS must be told so that its α is this one, 0 ≤ alpha ≤ lammps_damping(0); by bisection, as its polynomial
/// falls with e.
inline double lammps_restitution(double alpha) {
  double low = 0;
  double high = 1;
  for (;;) {
    const double middle = (low + high) / 2;
    if (middle <= low || middle >= high)
      return middle;
    (lammps_damping(middle) > alpha ? low : high) = middle;
  }
}

} // namespace tamp
