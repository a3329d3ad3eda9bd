// Hulls of support points by exact predicates.
#include "engine/measure/support.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <vector>

namespace tamp {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Distance of the origin from the segment a–b.
double distance_to_segment(const Vec<2>& a, const Vec<2>& b) {
  const Vec<2> along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp(-a.dot(along) / length, 0.0, 1.0) : 0.0;
  return (a + t * along).norm();
}

} // namespace

template <>
bool rests_on<2>(std::span<const Vec<1>> points, double tolerance) {
  bool left = false;
  bool right = false;
  for (const Vec<1>& p : points) {
    left = left || p[0] <= tolerance;
    right = right || p[0] >= -tolerance;
  }
  return left && right;
}

template <>
bool rests_on<3>(std::span<const Vec<2>> points, double tolerance) {
  if (points.empty())
    return false;
  std::vector<Kernel::Point_2> all;
  for (const Vec<2>& p : points)
    all.emplace_back(p[0], p[1]);
  std::vector<Kernel::Point_2> hull; // counter-clockwise, corners only
  CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(hull));

  const Kernel::Point_2 origin(0, 0);
  bool inside = hull.size() >= 3;
  double nearest = Vec<2>(hull.front().x(), hull.front().y()).norm();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const auto& a = hull[i];
    const auto& b = hull[(i + 1) % hull.size()];
    inside = inside && CGAL::orientation(a, b, origin) != CGAL::RIGHT_TURN;
    nearest = std::min(nearest, distance_to_segment({a.x(), a.y()}, {b.x(), b.y()}));
  }
  return inside || nearest <= tolerance;
}

} // namespace tamp
