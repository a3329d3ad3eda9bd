// Arcs around one and two contacts, and where those contacts let go.
#include "engine/generate/drop_and_roll/path.h"

#include "engine/generate/drop_and_roll/support.h"

#include <cmath>
#include <span>

namespace tamp {

namespace {

/// Ends the path at its lowest point, or at the first departure: a function that falls below zero where a contact would
/// have to pull.
template <int D>
bool close(Path<D>& path, double reach, std::span<const Sinusoid> departures) {
  const double rise = path.arc.first[vertical<D>];
  const double run = std::max(0.0, -path.arc.second[vertical<D>]);
  if (std::sqrt(rise * rise + run * run) <= kDirection * reach)
    return false; // a level circle
  path.end = ArcPoint::towards(-rise, run);
  path.ends_at_lowest = true;
  for (const Sinusoid& departure : departures) {
    ArcPoint where;
    if (entering(departure, 0, path.end, where) < path.end.u) {
      path.end = where;
      path.ends_at_lowest = false;
    }
  }
  return path.ends_at_lowest || path.end.u > kNoMotion;
}

/// The multiplier of contact `one` along an arc that keeps touching two spheres, up to a positive factor:
/// λ_1 ∝ n_1z − g n_2z, where g = n_1·n_2 stays the same.
Sinusoid multiplier(const Arc<3>& arc, const Constraint<3>& one, const Constraint<3>& two, double g) {
  const double k = 1 / one.reach - g / two.reach;
  const double at_centre =
      (arc.centre[2] - one.anchor[2]) / one.reach - g * (arc.centre[2] - two.anchor[2]) / two.reach;
  return {at_centre, k * arc.first[2], k * arc.second[2]};
}

/// The circle of radius √h2 around an axis through its centre, from the point nearest to p down (or to the given side).
Arc<3> circle(const Vec<3>& centre, const Vec<3>& axis, double h2, const Vec<3>& p, int side) {
  Arc<3> arc{centre, p - centre, {}};
  arc.first -= axis * axis.dot(arc.first);
  arc.first *= std::sqrt(h2) / arc.first.norm();
  arc.second = axis.cross(arc.first);
  const bool turn = side == kDownhill ? arc.second[2] > 0 : side % 2 == 1;
  if (turn)
    arc.second = -arc.second;
  return arc;
}

} // namespace

template <int D>
bool roll_around(const Constraint<D>& ball, const Vec<D>& p, int side, Path<D>& path) {
  const Vec<D> n = ball.normal(p);
  Vec<D> level = n; // horizontal part of the normal
  level[vertical<D>] = 0;
  const double slope = level.norm();
  Vec<D> downhill;
  if (side == kDownhill) {
    downhill = (n[vertical<D>] / slope) * level - slope * Vec<D>::Unit(vertical<D>);
  } else {
    downhill = (side % 2 == 0 ? 1.0 : -1.0) * Vec<D>::Unit(side / 2);
    downhill = (downhill - n * n.dot(downhill)).normalized();
  }
  path.arc = {ball.anchor, ball.reach * n, ball.reach * downhill};
  const Sinusoid equator = path.arc.height(vertical<D>, ball.anchor[vertical<D>]);
  return close<D>(path, ball.reach, {&equator, 1});
}

bool roll_along(const Constraint<3>& ball, const Constraint<3>& other, const Vec<3>& p, int side, Path<3>& path) {
  if (!other.is_sphere()) {
    const double foot = other.anchor[other.axis] - ball.anchor[other.axis];
    const double h2 = (ball.reach - foot) * (ball.reach + foot);
    if (h2 <= ball.tolerance * ball.reach)
      return false; // shrunk to a point
    const Vec<3> axis = Vec<3>::Unit(other.axis);
    path.arc = circle(ball.anchor + foot * axis, axis, h2, p, side);
    const Sinusoid equator = path.arc.height(2, ball.anchor[2]);
    return close<3>(path, ball.reach, {&equator, 1});
  }
  const Vec<3> between = other.anchor - ball.anchor;
  const double d = between.norm();
  const double foot = (d + (ball.reach - other.reach) * (ball.reach + other.reach) / d) / 2;
  const double h2 = (ball.reach - foot) * (ball.reach + foot);
  if (h2 <= ball.tolerance * ball.reach)
    return false;
  path.arc = circle(ball.anchor + between * (foot / d), between / d, h2, p, side);
  const double g = (ball.reach * ball.reach + other.reach * other.reach - d * d) / (2 * ball.reach * other.reach);
  const Sinusoid departures[] = {multiplier(path.arc, ball, other, g), multiplier(path.arc, other, ball, g)};
  return close<3>(path, ball.reach, departures);
}

template bool roll_around<2>(const Constraint<2>&, const Vec<2>&, int, Path<2>&);
template bool roll_around<3>(const Constraint<3>&, const Vec<3>&, int, Path<3>&);

} // namespace tamp
