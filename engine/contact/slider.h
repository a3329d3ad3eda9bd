// A spring in the tangent plane that slips at a limit: what friction and rolling resistance have in common.
#pragma once

#include "engine/base/vec.h"

#include <cmath>

namespace tamp {

/// Share of the limiting force by which a spring may stick out of the tangent plane before it is turned back (LAMMPS
/// has the same number in the same place).
inline constexpr double kTurnTolerance = 1e-10;

/// Moves the spring by velocity · dt and returns its force, −k s − c v, at most `limit`; where it slips, `stretch` is
/// set so that the force is the limit (Cundall & Strack, Géotechnique 29, 47, 1979; Luding, Granular Matter 10, 235,
/// 2008, eq. 16–21). As the contact turns, the stretch follows into the tangent plane and keeps its length.
/// normal: unit vector; velocity: in the tangent plane; stiffness > 0.
template <int D>
Vec<D> slide(Vec<D>& stretch, const Vec<D>& normal, const Vec<D>& velocity, double stiffness, double damping,
             double limit, double dt) {
  const double out = stretch.dot(normal);
  if (std::abs(out) * stiffness > kTurnTolerance * limit) {
    const double length2 = stretch.squaredNorm();
    stretch -= out * normal;
    const double left2 = stretch.squaredNorm();
    stretch *= left2 > 0 ? std::sqrt(length2 / left2) : 0.0;
  }
  stretch += velocity * dt;
  Vec<D> force = -stiffness * stretch - damping * velocity;
  const double size2 = force.squaredNorm();
  if (size2 > limit * limit) { // a root only for what slips
    force *= limit / std::sqrt(size2);
    stretch = -(force + damping * velocity) / stiffness;
  }
  return force;
}

} // namespace tamp
