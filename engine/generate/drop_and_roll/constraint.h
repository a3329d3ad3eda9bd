// What a rolling sphere may touch: the spheres of the bed and the faces of the box, as limits on its centre.
#pragma once

#include "engine/generate/drop_and_roll/arc.h"

#include <cmath>

namespace tamp {

/// Share of the smaller radius within which two spheres count as touching while one of them rolls, and by which a
/// graze may go unnoticed. Far above rounding (2e-16 of the box edge), far below the overlap that is allowed at the
/// end.
inline constexpr double kTouch = 1e-11;

/// A limit on the centre p of the rolling sphere: p stays outside a sphere of radius `reach` (the sum of both radii)
/// around `anchor`, or on the positive side of the plane through `anchor` with the normal sign·e_axis.
template <int D>
struct Constraint {
  Vec<D> anchor;
  double reach = 0;
  double tolerance = 0; ///< a length
  int axis = -1;        ///< of a plane; −1 for a sphere
  double sign = 1;

  static Constraint sphere(const Vec<D>& centre, double radius, double own_radius) {
    return {centre, radius + own_radius, kTouch * std::min(radius, own_radius), -1, 1};
  }
  static Constraint plane(int axis, double level, double sign, double own_radius) {
    Vec<D> anchor = Vec<D>::Zero();
    anchor[axis] = level;
    return {anchor, 0, kTouch * own_radius, axis, sign};
  }

  [[nodiscard]] bool is_sphere() const { return axis < 0; }

  /// Unit normal at p, away from the obstacle.
  [[nodiscard]] Vec<D> normal(const Vec<D>& p) const {
    if (is_sphere())
      return (p - anchor).normalized();
    return sign * Vec<D>::Unit(axis);
  }

  /// Distance of the surfaces; negative where they overlap.
  [[nodiscard]] double gap(const Vec<D>& p) const {
    if (is_sphere())
      return (p - anchor).norm() - reach;
    return sign * (p[axis] - anchor[axis]);
  }

  /// The first point of an arc where this constraint stops it; u = ∞ for none before `end`.
  [[nodiscard]] double stops(const Arc<D>& arc, const ArcPoint& end, ArcPoint& where) const {
    if (is_sphere())
      return entering(arc.clearance(anchor, reach), 2 * reach * tolerance, end, where);
    const Sinusoid h = arc.height(axis, anchor[axis]);
    return entering({sign * h.a, sign * h.b, sign * h.c}, tolerance, end, where);
  }

  /// The height at which a centre falling straight down from p lands on this sphere; −∞ if it passes by.
  [[nodiscard]] double landing(const Vec<D>& p) const {
    const double lateral2 = (p - anchor).template head<D - 1>().squaredNorm();
    const double clear = reach - 2 * tolerance; // what a roll grazed must not stop the fall that follows
    if (lateral2 >= clear * clear)
      return -std::numeric_limits<double>::infinity();
    return anchor[vertical<D>] + std::sqrt(reach * reach - lateral2);
  }
};

} // namespace tamp
