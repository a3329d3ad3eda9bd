// Fall, roll, depart, touch: the events of one descent.
#include "engine/generate/drop_and_roll/descent.h"

#include <algorithm>
#include <limits>

namespace tamp {

namespace {

/// A descent has a handful of events; a large sphere settling through small ones has thousands. Beyond this many,
/// rounding must be turning it in circles.
constexpr int kMaxSteps = 1000000;

/// Events in a row without coming lower after which a balanced sphere is left where it is: no fewer than the contacts
/// that may have to be found, one an event. Between walls that leave it less than its normals are exact to, it would go
/// from side to side for ever.
constexpr int kMaxIdle = 64;

/// A slope that a sphere may as well cross another way than straight down, which rounding can point into a neighbour
/// that only touches: over the top it rises by half its square, which is no length.
constexpr double kLevel = 100 * kDirection;

/// How far, in its own radii, a sphere travels before its surroundings are gathered anew: further where there was
/// little to gather (on the flank of a much larger sphere), up to kFurthestReach. Measured in 3D: reaches from 1 to 2
/// cost the same within noise; letting it grow saves a tenth of the lognormal powder's time and a fifth of the events
/// at size ratio 40, but beyond 4 radii the larger searches cost more than they save.
constexpr double kGatherReach = 1.4;
constexpr double kFurthestReach = 4;
constexpr std::size_t kFewObstacles = 8;
constexpr std::size_t kManyObstacles = 30;

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
  begin(p, radius);
  for (int i = 0; i < kMaxSteps; ++i) {
    if (const std::optional<End> end = advance()) {
      p = p_;
      return *end;
    }
  }
  return End::unresolved;
}

template <int D>
void Descent<D>::begin(const Vec<D>& p, double radius) {
  p_ = p;
  radius_ = radius;
  touching_.clear();
  normals_.clear();
  reach_ = kGatherReach;
  near_.assign(kFewObstacles, {}); // the first search keeps to the reach
  lowest_ = p[vertical<D>];
  idle_ = 0;
}

template <int D>
std::optional<typename Descent<D>::End> Descent<D>::advance() {
  ++events_;
  const Step result = step();
  if (result == Step::moved)
    return std::nullopt;
  return result == Step::stable && overlaps_nothing() ? End::stable : End::unresolved;
}

template <int D>
void Descent<D>::gather() {
  gathered_at_ = p_;
  if (near_.size() < kFewObstacles)
    reach_ = std::min(2 * reach_, kFurthestReach);
  else if (near_.size() > kManyObstacles)
    reach_ = std::max(reach_ / 2, kGatherReach);
  gathered_reach_ = reach_ * radius_;
  near_.clear();
  near_.push_back(Constraint<D>::plane(vertical<D>, radius_, 1, radius_));
  for (int a = 0; a < D - 1; ++a) {
    if (periodic_[static_cast<std::size_t>(a)])
      continue;
    near_.push_back(Constraint<D>::plane(a, radius_, 1, radius_));
    near_.push_back(Constraint<D>::plane(a, size_[a] - radius_, -1, radius_));
  }
  grid_.for_each_ahead(p_, radius_, gathered_reach_, [&](const Vec<D>& centre, double radius) {
    near_.push_back(Constraint<D>::sphere(centre, radius, radius_));
  });
}

template <int D>
typename Descent<D>::Step Descent<D>::step() {
  if (is_supported(true))
    return Step::stable;
  if (is_idle() && is_balanced())
    return Step::stable;
  if (fall_is_free())
    return fall();
  Path<D> path;
  Support<D> guide;
  if (choose_path(path, guide)) {
    if (const Step result = follow(path, guide); result != Step::stuck)
      return result;
  }
  if (passes_between())
    return fall();
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

/// On fewer contacts than D, that leave no velocity.
template <int D>
bool Descent<D>::is_balanced() const {
  for (int size = 1; size < D; ++size) {
    if (for_each_support<D>(touching_.size(), size, [&](Support<D>& support) {
          return presses(normals_, support) && support.velocity.norm() < kLevel && admissible(support);
        }))
      return true;
  }
  return false;
}

template <int D>
bool Descent<D>::is_idle() {
  if (const double z = p_[vertical<D>]; z < lowest_ - kNoMotion * radius_) {
    lowest_ = z;
    idle_ = 0;
  }
  return ++idle_ > kMaxIdle;
}

template <int D>
bool Descent<D>::fall_is_free() const {
  return std::all_of(normals_.begin(), normals_.end(), [](const Vec<D>& n) { return n[vertical<D>] <= kDirection; });
}

/// Whether everything that touches would only be grazed by a fall: the sphere is in a throat of its own size.
template <int D>
bool Descent<D>::passes_between() const {
  return std::none_of(touching_.begin(), touching_.end(), [&](const Constraint<D>& c) {
    return c.is_sphere() ? std::isfinite(c.landing(p_)) : c.axis == vertical<D>;
  });
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
bool Descent<D>::choose_path(Path<D>& path, Support<D>& guide) const {
  for (int size = 1; size < D; ++size) {
    const bool found = for_each_support<D>(touching_.size(), size, [&](Support<D>& support) {
      if (!presses(normals_, support) || !admissible(support))
        return false;
      guide = support;
      // Balanced on a top, a sphere may go either way; it takes the first that is free.
      const double slope = support.velocity.norm();
      const int first = slope < kDirection ? 0 : kDownhill;
      const int last = slope < kLevel ? kSides<D> - 1 : kDownhill;
      for (int side = first; side <= last; ++side) {
        if (make_path(support, side, path) && !is_blocked(path, support))
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

/// The path that a support guides; false where there is none. Walls alone guide nothing: the sphere falls along them.
template <int D>
bool Descent<D>::make_path(const Support<D>& support, int side, Path<D>& path) const {
  const Constraint<D>& first = touching_[support.member[0]];
  if (support.count == 1)
    return first.is_sphere() && roll_around(first, p_, side, path);
  if constexpr (D == 3) {
    const Constraint<D>& second = touching_[support.member[1]];
    if (first.is_sphere())
      return roll_along(first, second, p_, side, path);
    return second.is_sphere() && roll_along(second, first, p_, side, path);
  }
  return false;
}

/// Whether a contact that does not guide the path stops it before it has moved the sphere by more than the tolerance
/// within which that contact touches.
template <int D>
bool Descent<D>::is_blocked(const Path<D>& path, const Support<D>& guide) const {
  for (std::size_t j = 0; j < touching_.size(); ++j) {
    const auto* last = guide.member.begin() + guide.count;
    if (std::find(guide.member.begin(), last, j) != last)
      continue;
    ArcPoint where;
    const double angle = 2 * touching_[j].stops(path.arc, path.end, where); // near enough where it is small
    if (angle * path.arc.first.norm() <= touching_[j].tolerance)
      return true;
  }
  return false;
}

template <int D>
typename Descent<D>::Step Descent<D>::follow(const Path<D>& path, const Support<D>& guide) {
  const auto guides = [&](const Constraint<D>& c) {
    for (int i = 0; i < guide.count; ++i) {
      if (same(c, touching_[guide.member[static_cast<std::size_t>(i)]]))
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
    drop_contacts(guide);
    gather();
    return Step::moved;
  }
  // A contact so near that it touches already stops the sphere where it is: else two such contacts in turn, each out of
  // touch with the other, would keep it going for ever.
  const double way = 2 * best.u * path.arc.first.norm(); // near enough where it is short
  if (met != nullptr && (best.u <= kNoMotion || way <= met->tolerance)) {
    if (is_touching(*met))
      return Step::stuck;
    add_touching(*met);
    return Step::moved;
  }
  p_ = path.arc.point(best);
  drop_contacts(guide);
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
