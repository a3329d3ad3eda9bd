// Derjaguin, Muller and Toporov's adhesion: Hertz's contact pulled together by a constant force.
#pragma once

#include "engine/contact/hertz.h"

namespace tamp {

/// F = 4/3 E* √R δ^{3/2} − 2πWR, a = √(Rδ) (Derjaguin, Muller & Toporov, J. Colloid Interface Sci. 53, 314, 1975; in
/// the form of Maugis, ibid. 150, 243, 1992). For hard, small spheres of weak adhesion: small Tabor parameter. The
/// contact forms and breaks at δ = 0, so approach and retreat follow one curve and nothing is lost.
/// LAMMPS: `dmt`, whose surface energy is W/2.
struct Dmt {
  double modulus;  ///< E*
  double adhesion; ///< work of adhesion W, energy per area

  static constexpr bool adheres = true;
  struct Memory {};

  [[nodiscard]] NormalForce at(double overlap, double radius) const {
    NormalForce contact = Hertz{modulus}.at(overlap, radius);
    contact.force -= pull_off(radius);
    return contact;
  }
  [[nodiscard]] double energy(double overlap, double radius) const {
    return Hertz{modulus}.energy(overlap, radius) - pull_off(radius) * overlap;
  }
  /// 2πWR.
  [[nodiscard]] double pull_off(double radius) const { return 2 * std::numbers::pi * adhesion * radius; }
  [[nodiscard]] static double reach(double /*radius*/) { return 0; }
};

} // namespace tamp
