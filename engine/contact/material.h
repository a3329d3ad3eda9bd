// Elastic constants of a pair of materials, and the radius and mass that stand for a pair of spheres.
#pragma once

namespace tamp {

/// A linear elastic, isotropic solid. Any consistent units: the laws know no unit.
struct Elastic {
  double young;   ///< E, force per area
  double poisson; ///< nu, in (−1, 0.5]
};

/// E* of two solids: 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ (Johnson, Contact Mechanics, 1985, eq. 4.5).
inline double effective_modulus(const Elastic& a, const Elastic& b) {
  return 1 / ((1 - a.poisson * a.poisson) / a.young + (1 - b.poisson * b.poisson) / b.young);
}

/// G* of two solids: 1/G* = (2 − ν₁)/G₁ + (2 − ν₂)/G₂ with G = E/(2(1 + ν)) (Mindlin, J. Appl. Mech. 16, 259, 1949).
inline double effective_shear_modulus(const Elastic& a, const Elastic& b) {
  const auto compliance = [](const Elastic& m) { return 2 * (2 - m.poisson) * (1 + m.poisson) / m.young; };
  return 1 / (compliance(a) + compliance(b));
}

/// ab/(a + b): effective radius of two radii, effective mass of two masses. Against a wall it is a itself.
inline double effective(double a, double b) {
  return a * b / (a + b);
}

} // namespace tamp
