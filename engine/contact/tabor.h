// Tabor's parameter, which says whether spheres adhere as Johnson, Kendall and Roberts or as Derjaguin, Muller and
// Toporov found.
#pragma once

#include <cmath>

namespace tamp {

/// μ_T = (R W²/(E*² z₀³))^{1/3} (Tabor, J. Colloid Interface Sci. 58, 2, 1977): how far the neck stretches, in units of
/// z₀, the distance over which surfaces attract each other (about 0.3 nm for solids).
inline double tabor_parameter(double modulus, double adhesion, double radius, double attraction_range) {
  const double ratio = adhesion / modulus;
  return std::cbrt(radius * ratio * ratio / (attraction_range * attraction_range * attraction_range));
}

/// Distance z₀ over which solid surfaces attract each other, in metres (Israelachvili, Intermolecular and Surface
/// Forces, 2011: 0.165 nm between van der Waals planes, up to the lattice spacing of 0.4 nm).
inline constexpr double kAttractionRange = 0.3e-9;

/// From this Tabor parameter on JKR, below it DMT. Between the two laws the pull-off force goes from 2πWR to 3/2 πWR
/// as F/(πWR) = 7/4 − 1/4 (4.04 λ^{1.4} − 1)/(4.04 λ^{1.4} + 1), λ = 1.16 μ_T (Carpick, Ogletree & Salmeron, J. Colloid
/// Interface Sci. 211, 395, 1999); it is half-way at μ_T = 0.32, where either law is off by a seventh at most.
inline constexpr double kTaborThreshold = 0.32;

inline bool adheres_as_jkr(double tabor) {
  return tabor >= kTaborThreshold;
}

} // namespace tamp
