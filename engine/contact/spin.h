// Angular velocities and torques: a number in 2D, a vector in 3D, with the cross products that join them to vectors.
#pragma once

#include "engine/base/vec.h"

#include <type_traits>

namespace tamp {

/// Angular velocity, angular momentum or torque. In 2D its one component points out of the plane.
template <int D>
using Spin = std::conditional_t<D == 2, double, Vec<3>>;

template <int D>
Spin<D> zero_spin() {
  if constexpr (D == 2)
    return 0.0;
  else
    return Vec<3>::Zero();
}

/// ω × v: the velocity at v on a body turning about the origin.
inline Vec<2> cross(double spin, const Vec<2>& v) {
  return {-spin * v[1], spin * v[0]};
}
inline Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a × b: the torque of force b at a; in 3D it is the same product.
inline double cross(const Vec<2>& a, const Vec<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// Moment of inertia about the centre divided by m r²: of a disc, of a solid sphere.
template <int D>
inline constexpr double gyration = D == 2 ? 0.5 : 0.4;

} // namespace tamp
