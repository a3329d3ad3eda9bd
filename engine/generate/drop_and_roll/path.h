// The paths of a rolling sphere: around one contact, or guided by two, down to where it ends by itself.
#pragma once

#include "engine/base/vec.h"
#include "engine/generate/drop_and_roll/arc.h"
#include "engine/generate/drop_and_roll/constraint.h"

namespace tamp {

/// Arcs shorter than this angle (as u = tan(t/2)) do not move a sphere by more than rounding.
inline constexpr double kNoMotion = 1e-13;

/// An arc and the point where it ends if nothing stops it: its lowest point, or where a guiding contact would have to
/// pull.
template <int D>
struct Path {
  Arc<D> arc;
  ArcPoint end;
  bool ends_at_lowest = false;
};

/// Direction of a sphere that is not balanced: down the slope. A balanced one is given a side instead: 0, 1, ….
inline constexpr int kDownhill = -1;

/// Number of sides that a balanced sphere may be given: both directions of each lateral axis.
template <int D>
inline constexpr int kSides = 2 * (D - 1);

/// The arc around one sphere, in the vertical plane through both centres. False where it leads nowhere.
template <int D>
bool roll_around(const Constraint<D>& ball, const Vec<D>& p, int side, Path<D>& path);

/// The arc that keeps touching a sphere and a second contact, sphere or wall: around the common axis of two spheres, or
/// around the normal of the wall. False where it leads nowhere.
bool roll_along(const Constraint<3>& ball, const Constraint<3>& other, const Vec<3>& p, int side, Path<3>& path);

} // namespace tamp
