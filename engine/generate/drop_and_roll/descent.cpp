// Fall, roll, depart, touch: the events of one descent.
#include "engine/generate/drop_and_roll/descent.h"

#include <algorithm>
#include <limits>

namespace tamp {

namespace {

/// Arcs shorter than this angle (as u = tan(t/2)) do not move a sphere by more than rounding: a contact met within it
/// is met at once.
constexpr double kBlocked = 1e-13;

/// A descent has a handful of events; a large sphere settling through small ones has thousands. Beyond this many,
/// rounding must be turning it in circles.
constexpr int kMaxSteps = 1000000;

/// How far, in its own radii, a sphere travels before its surroundings are gathered anew.
constexpr double kGatherReach = 1.0;

template <int D>
bool same(const Constraint<D>& a, const Constraint<D>& b) {
  return a.axis == b.axis && a.sign == b.sign && a.anchor == b.anchor;
}

} // namespace

template <int D>
Descent<D>::Descent(const Vec<D>& size, const std::array<bool, D>& periodic, const HierarchicalGrid<D>& grid)
    : size_(size), periodic_(periodic), grid_(grid) {}

template <int D>
typename Descent<D>::End Descent<D>::run(Vec<D>& p, double radius) {
  p_ = p;
  radius_ = radius;
  touching_.clear();
  normals_.clear();
  for (int i = 0; i < kMaxSteps; ++i) {
    ++events_;
    const Step result = step();
    if (result == Step::moved)
      continue;
    p = p_;
    return result == Step::stable && overlaps_nothing() ? End::stable : End::unresolved;
  }
  return End::unresolved;
}

template <int D>
void Descent<D>::gather() {
  gathered_at_ = p_;
  gathered_reach_ = kGatherReach * radius_;
  near_.clear();
  near_.push_back(Constraint<D>::plane(vertical<D>, radius_, 1, radius_));
  for (int a = 0; a < D - 1; ++a) {
    if (periodic_[static_cast<std::size_t>(a)])
      continue;
    near_.push_back(Constraint<D>::plane(a, radius_, 1, radius_));
    near_.push_back(Constraint<D>::plane(a, size_[a] - radius_, -1, radius_));
  }
  grid_.for_each_near(p_, radius_ + gathered_reach_, [&](const Vec<D>& centre, double radius) {
    near_.push_back(Constraint<D>::sphere(centre, radius, radius_));
  });
}

template <int D>
typename Descent<D>::Step Descent<D>::step() {
  if (is_supported(true))
    return Step::stable;
  if (fall_is_free())
    return fall();
  Path path;
  if (choose_path(path))
    return follow(path);
  return is_supported(false) ? Step::stable : Step::stuck;
}

/// At rest on the floor, or on D contacts whose pushes add up to the weight. A support where one push is zero (a sphere
/// on the top of another that leans on a wall) holds only if no path leads away from it.
template <int D>
bool Descent<D>::is_supported(bool firmly) const {
  const bool on_floor =
      std::any_of(touching_.begin(), touching_.end(), [](const Constraint<D>& c) { return c.axis == vertical<D>; });
  return on_floor || for_each_support<D>(touching_.size(), D, [&](Support<D>& support) {
           return presses(normals_, support) && (!firmly || is_firm(support));
         });
}

template <int D>
bool Descent<D>::fall_is_free() const {
  return std::all_of(normals_.begin(), normals_.end(), [](const Vec<D>& n) { return n[vertical<D>] <= kDirection; });
}

template <int D>
typename Descent<D>::Step Descent<D>::fall() {
  double& z = p_[vertical<D>];
  Constraint<D> met = Constraint<D>::plane(vertical<D>, radius_, 1, radius_);
  double height = radius_;
  grid_.for_each_below(p_, radius_, height, [&](const Vec<D>& centre, double radius) {
    // A sphere whose equator is above p cannot be landed on, only passed; one too low changes nothing.
    if (centre[vertical<D>] <= z && centre[vertical<D>] + radius + radius_ > height) {
      const auto sphere = Constraint<D>::sphere(centre, radius, radius_);
      if (const double landing = sphere.landing(p_); landing > height) {
        height = landing;
        met = sphere;
      }
    }
    return height;
  });
  if (is_touching(met))
    return Step::stuck;
  if (height < z) {
    z = height;
    drop_contacts({});
  }
  gather();
  add_touching(met);
  return Step::moved;
}

/// The first set of contacts that gravity presses on and that has an arc nothing else blocks. Generically there is one;
/// where several touch at the same instant the order of the search decides.
template <int D>
bool Descent<D>::choose_path(Path& path) const {
  constexpr int sides = 2 * (D - 1);
  for (int size = 1; size < D; ++size) {
    const bool found = for_each_support<D>(touching_.size(), size, [&](Support<D>& support) {
      if (!presses(normals_, support) || !admissible(support))
        return false;
      // Balanced on a top, a sphere may go either way; it takes the first that is free.
      const bool balanced = support.velocity.norm() < kDirection;
      for (int side = 0; side < (balanced ? sides : 1); ++side) {
        if (make_path(support, balanced ? side : -1, path) && !is_blocked(path))
          return true;
      }
      return false;
    });
    if (found)
      return true;
  }
  return false;
}

template <int D>
bool Descent<D>::admissible(const Support<D>& support) const {
  return std::all_of(normals_.begin(), normals_.end(),
                     [&](const Vec<D>& n) { return support.velocity.dot(n) >= -kDirection; });
}

/// The arc around one sphere in the vertical plane of its centre, or around the common axis of two contacts. It ends at
/// its lowest point or where one of the contacts would have to pull. `side` chooses a direction for a balanced sphere;
/// −1 for any other.
template <int D>
bool Descent<D>::make_path(const Support<D>& support, int side, Path& path) const {
  const auto member = [&](int i) -> const Constraint<D>& {
    return touching_[support.member[static_cast<std::size_t>(i)]];
  };
  const bool first_is_sphere = member(0).is_sphere();
  const Constraint<D>& ball = first_is_sphere ? member(0) : member(support.count - 1);
  if (!ball.is_sphere())
    return false; // walls alone guide nothing: the sphere falls along them

  Arc<D>& arc = path.arc;
  Sinusoid departure[2]; // each falls below zero where a contact would have to pull
  int departures = 1;
  if (support.count == 1) {
    const Vec<D> n = ball.normal(p_);
    Vec<D> level = n; // horizontal part of the normal
    level[vertical<D>] = 0;
    const double slope = level.norm();
    Vec<D> downhill = -slope * Vec<D>::Unit(vertical<D>);
    if (side < 0) {
      downhill += (n[vertical<D>] / slope) * level;
    } else {
      downhill = (side % 2 == 0 ? 1.0 : -1.0) * Vec<D>::Unit(side / 2);
      downhill = (downhill - n * n.dot(downhill)).normalized();
    }
    arc = {ball.anchor, ball.reach * n, ball.reach * downhill};
    departure[0] = arc.height(vertical<D>, ball.anchor[vertical<D>]);
  } else if constexpr (D == 3) {
    const Constraint<D>& other = first_is_sphere ? member(1) : member(0);
    Vec<D> axis = Vec<D>::Zero();
    double foot = 0; // of the arc's centre along the axis, from the ball's anchor
    double other_distance = 0;
    if (other.is_sphere()) {
      axis = other.anchor - ball.anchor;
      other_distance = axis.norm();
      axis /= other_distance;
      foot = (other_distance + (ball.reach - other.reach) * (ball.reach + other.reach) / other_distance) / 2;
    } else {
      axis = Vec<D>::Unit(other.axis);
      foot = other.anchor[other.axis] - ball.anchor[other.axis];
    }
    const double h2 = (ball.reach - foot) * (ball.reach + foot);
    if (h2 <= ball.tolerance * ball.reach)
      return false; // the circle has shrunk to a point
    arc.centre = ball.anchor + foot * axis;
    arc.first = p_ - arc.centre;
    arc.first -= axis * axis.dot(arc.first);
    arc.first *= std::sqrt(h2) / arc.first.norm();
    arc.second = axis.cross(arc.first);
    if (side < 0 ? arc.second[2] > 0 : side % 2 == 1)
      arc.second = -arc.second;
    const Sinusoid z = arc.height(2, 0);
    if (other.is_sphere()) {
      // λ_1 ∝ n_1z − g n_2z with g = n_1·n_2 constant along the arc, and the same with the roles exchanged
      const double g = (ball.reach * ball.reach + other.reach * other.reach - other_distance * other_distance) /
                       (2 * ball.reach * other.reach);
      const auto multiplier = [&](const Constraint<D>& one, const Constraint<D>& two) {
        const double k = 1 / one.reach - g / two.reach;
        const double at_centre =
            (arc.centre[2] - one.anchor[2]) / one.reach - g * (arc.centre[2] - two.anchor[2]) / two.reach;
        return Sinusoid{at_centre, k * z.b, k * z.c};
      };
      departure[0] = multiplier(ball, other);
      departure[1] = multiplier(other, ball);
      departures = 2;
    } else {
      departure[0] = arc.height(2, ball.anchor[2]);
    }
  }

  const double rise = arc.first[vertical<D>];
  const double run = std::max(0.0, -arc.second[vertical<D>]);
  if (std::hypot(rise, run) <= kDirection * ball.reach)
    return false; // a level circle leads nowhere
  path.end = ArcPoint::towards(-rise, run);
  path.ends_at_lowest = true;
  path.support = support;
  for (int i = 0; i < departures; ++i) {
    ArcPoint where;
    if (entering(departure[i], 0, path.end, where) < path.end.u) {
      path.end = where;
      path.ends_at_lowest = false;
    }
  }
  return path.ends_at_lowest || path.end.u > kBlocked;
}

/// Whether a contact that does not guide the path stops it before it has moved the sphere by more than the tolerance
/// within which that contact touches.
template <int D>
bool Descent<D>::is_blocked(const Path& path) const {
  for (std::size_t j = 0; j < touching_.size(); ++j) {
    const auto* last = path.support.member.begin() + path.support.count;
    if (std::find(path.support.member.begin(), last, j) != last)
      continue;
    ArcPoint where;
    const double angle = 2 * touching_[j].stops(path.arc, path.end, where); // near enough where it is small
    if (angle * path.arc.first.norm() <= touching_[j].tolerance)
      return true;
  }
  return false;
}

template <int D>
typename Descent<D>::Step Descent<D>::follow(const Path& path) {
  const auto guides = [&](const Constraint<D>& c) {
    for (int i = 0; i < path.support.count; ++i) {
      if (same(c, touching_[path.support.member[static_cast<std::size_t>(i)]]))
        return true;
    }
    return false;
  };
  ArcPoint best = path.end;
  const Constraint<D>* met = nullptr;
  for (const Constraint<D>& c : near_) {
    ArcPoint where;
    if (c.stops(path.arc, best, where) < best.u && !guides(c)) {
      best = where;
      met = &c;
    }
  }
  Sinusoid out = path.arc.clearance(gathered_at_, gathered_reach_);
  out = {-out.a, -out.b, -out.c};
  ArcPoint exit;
  const bool leaves = entering(out, 0, best, exit) < best.u;

  if (leaves) {
    p_ = path.arc.point(exit);
    drop_contacts(path.support);
    gather();
    return Step::moved;
  }
  if (met != nullptr && best.u <= kBlocked) {
    if (is_touching(*met))
      return Step::stuck;
    add_touching(*met);
    return Step::moved;
  }
  p_ = path.arc.point(best);
  drop_contacts(path.support);
  if (met != nullptr) {
    if (!is_touching(*met))
      add_touching(*met);
    return Step::moved;
  }
  return path.ends_at_lowest ? Step::stable : Step::moved;
}

/// After a move: keeps the members of the support that guided it and whatever else still touches (a move can be shorter
/// than the tolerance), and renews the normals.
template <int D>
void Descent<D>::drop_contacts(const Support<D>& guide) {
  const auto* guides_end = guide.member.begin() + guide.count;
  std::size_t kept = 0;
  for (std::size_t j = 0; j < touching_.size(); ++j) {
    const bool guides = std::find(guide.member.begin(), guides_end, j) != guides_end;
    if (guides || touching_[j].gap(p_) <= touching_[j].tolerance)
      touching_[kept++] = touching_[j];
  }
  touching_.resize(kept);
  normals_.clear();
  for (const Constraint<D>& c : touching_)
    normals_.push_back(c.normal(p_));
}

template <int D>
void Descent<D>::add_touching(const Constraint<D>& constraint) {
  touching_.push_back(constraint);
  normals_.push_back(constraint.normal(p_));
}

template <int D>
bool Descent<D>::is_touching(const Constraint<D>& constraint) const {
  return std::any_of(touching_.begin(), touching_.end(), [&](const Constraint<D>& c) { return same(c, constraint); });
}

template <int D>
bool Descent<D>::overlaps_nothing() const {
  return std::all_of(near_.begin(), near_.end(),
                     [&](const Constraint<D>& c) { return c.gap(p_) >= -c.tolerance * (kPlacedOverlap / kTouch); });
}

template class Descent<2>;
template class Descent<3>;

} // namespace tamp
