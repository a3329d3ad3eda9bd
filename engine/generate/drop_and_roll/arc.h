// Circular arcs, the paths of a rolling sphere, and the one equation that finds every event on them.
#pragma once

#include "engine/base/vec.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tamp {

/// A point t ∈ [0, π] of an arc, as cosine, sine and u = tan(t/2), which grows with t and keeps small angles exact.
struct ArcPoint {
  double c = 1;
  double s = 0;
  double u = 0;

  static ArcPoint start() { return {}; }
  static ArcPoint half_turn() { return {-1, 0, std::numeric_limits<double>::infinity()}; }
  /// From a direction (x, y) with y ≥ 0, not both zero.
  static ArcPoint towards(double x, double y) {
    const double length = std::sqrt(x * x + y * y);
    const double c = x / length;
    const double s = y / length;
    // tan(t/2) in the form without cancellation on either side of a quarter turn
    return {c, s, c > 0 ? s / (1 + c) : (s > 0 ? (1 - c) / s : std::numeric_limits<double>::infinity())};
  }
  static ArcPoint never() { return {0, 0, std::numeric_limits<double>::infinity()}; }
};

/// f(t) = a + b cos t + c sin t: the value of any constraint along an arc.
struct Sinusoid {
  double a = 0;
  double b = 0;
  double c = 0;

  [[nodiscard]] double at(const ArcPoint& t) const { return a + b * t.c + c * t.s; }
};

/// The first t in [0, end] where f, which starts at or above −tolerance, goes below zero and then deeper than
/// −tolerance before `end`; u = ∞ if it never does. Shallower dips are grazes that leave no mark. A constraint that
/// already touches and is being entered gives t = 0.
/// The roots of f are −a b/m² ∓ c q/m² (cosine), −a c/m² ± b q/m² (sine), m² = b² + c², q² = m² − a²; f falls at the
/// upper signs, so one square root finds the entering one.
inline double entering(const Sinusoid& f, double tolerance, const ArcPoint& end, ArcPoint& where) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double m2 = f.b * f.b + f.c * f.c;
  const double lifted = f.a + tolerance;
  if (lifted >= 0 && lifted * lifted >= m2)
    return never;

  // Without a minimum on the way the end is the deepest point: most constraints are passed without a root.
  const bool minimum_inside = f.c < 0 && f.c * end.c > f.b * end.s;
  if (!minimum_inside && f.at(end) >= 0)
    return never;

  const double q = std::sqrt(std::max(0.0, m2 - f.a * f.a));
  const double x = -f.a * f.b - f.c * q;
  const double y = -f.a * f.c + f.b * q;
  const double at_start = f.a + f.b;
  const bool falling = f.c < 0;
  if (falling && at_start <= 0) {
    where = ArcPoint::start();
  } else if (y >= 0) {
    where = ArcPoint::towards(x, y);
  } else if (falling && at_start <= tolerance) {
    where = ArcPoint::start(); // rounding put the root of a touching constraint just behind the start
  } else {
    return never;
  }
  if (where.u > end.u)
    return never;
  // Where the minimum lies beyond the end of the arc, the end is the deepest point reached.
  const bool minimum_ahead = f.c >= 0 || -f.c > end.u * (std::sqrt(m2) - f.b);
  if (minimum_ahead && f.at(end) >= -tolerance)
    return never;
  return where.u;
}

/// p(t) = centre + cos t · first + sin t · second, both of the arc's radius and at right angles.
template <int D>
struct Arc {
  Vec<D> centre;
  Vec<D> first;
  Vec<D> second;

  [[nodiscard]] Vec<D> point(const ArcPoint& t) const { return centre + t.c * first + t.s * second; }

  /// |p(t) − q|² − distance²
  [[nodiscard]] Sinusoid clearance(const Vec<D>& q, double distance) const {
    const Vec<D> d = centre - q;
    return {d.squaredNorm() + first.squaredNorm() - distance * distance, 2 * d.dot(first), 2 * d.dot(second)};
  }

  /// p_axis(t) − level
  [[nodiscard]] Sinusoid height(int axis, double level) const {
    return {centre[axis] - level, first[axis], second[axis]};
  }
};

} // namespace tamp
