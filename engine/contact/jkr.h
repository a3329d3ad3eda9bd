// Johnson, Kendall and Roberts' adhesion: the surfaces stick inside the contact and form a neck before they part.
#pragma once

#include "engine/contact/hertz.h"

#include <algorithm>

namespace tamp {

/// δ = a²/R − √(2πWa/E*), F = 4E*a³/(3R) − √(8πWE*a³) (Johnson, Kendall & Roberts, Proc. R. Soc. A 324, 301, 1971).
/// For soft, large spheres of strong adhesion: large Tabor parameter.
///
/// The contact forms when the surfaces meet (δ = 0, where F jumps to −4/3 πWR) and holds until the pull reaches its
/// largest, 3/2 πWR, at δ = −a²/(3R) with a³ = 9πWR²/(8E*). The work on the way back is lost: that is the hysteresis. A
/// test machine that holds δ could follow the curve further, to a pull of 5/6 πWR; like LAMMPS (`jkr`, surface energy
/// W/2) and Thornton (Granular Dynamics, 2015, section 3.2) the contact breaks here where the force is largest.
struct Jkr {
  double modulus;  ///< E*
  double adhesion; ///< work of adhesion W, energy per area

  static constexpr bool adheres = true;
  /// Whether the surfaces have met since they last parted.
  struct Memory {
    bool touching = false;
  };

  /// At an overlap δ ≥ −reach(radius); negative: the spheres hold on to each other by the neck.
  [[nodiscard]] NormalForce at(double overlap, double radius) const {
    const double a = contact_radius(overlap, radius);
    return {(4.0 / 3.0 * a * a / radius - 2 * stretch() * std::sqrt(a)) * modulus * a, a};
  }

  /// ∫₀^δ F dδ: from the first touch.
  [[nodiscard]] double energy(double overlap, double radius) const {
    return energy_of(contact_radius(overlap, radius), radius) - energy_of(contact_radius(0, radius), radius);
  }

  /// 3/2 πWR.
  [[nodiscard]] double pull_off(double radius) const { return 1.5 * std::numbers::pi * adhesion * radius; }

  [[nodiscard]] double reach(double radius) const {
    const double a = std::cbrt(9 * std::numbers::pi * adhesion * radius * radius / (8 * modulus));
    return a * a / (3 * radius);
  }

private:
  /// ∫F dδ from a = 0 along the curve of δ(a) and F(a).
  [[nodiscard]] double energy_of(double a, double radius) const {
    const double s = stretch();
    const double a2 = a * a;
    return modulus * a2 * (8.0 / 15.0 * a2 * a / (radius * radius) - 4.0 / 3.0 * s * a * std::sqrt(a) / radius) +
           modulus * s * s / 2 * a2;
  }

  /// √(2πW/E*): the neck lengthens the contact by this times √a.
  [[nodiscard]] double stretch() const { return std::sqrt(2 * std::numbers::pi * adhesion / modulus); }

  /// The larger root a of δ(a) = δ, by Newton's method for x = √a: x⁴/R − s x − δ is convex and its slope positive at
  /// the root, so from above every step goes down until rounding stops it. (The quartic's closed form, as in Parteli et
  /// al., Sci. Rep. 4, 6227, 2014, loses half the digits as W vanishes.)
  [[nodiscard]] double contact_radius(double overlap, double radius) const {
    const double s = stretch();
    double x = std::max(std::sqrt(std::sqrt(2 * radius * std::max(overlap, 0.0))), std::cbrt(2 * radius * s));
    if (x == 0)
      return 0;
    for (;;) {
      const double x3 = x * x * x / radius;
      const double next = x - (x3 * x - s * x - overlap) / (4 * x3 - s);
      if (!(next < x))
        return x * x;
      x = next;
    }
  }
};

} // namespace tamp
