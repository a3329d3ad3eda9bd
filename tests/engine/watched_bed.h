// A bed whose every descent is watched from event to event and checked against all spheres by brute force, in several
// units of length.
#pragma once

#include "engine/generate/drop_and_roll/descent.h"
#include "engine/measure/support.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace tamp::test {

template <int D>
struct Sphere {
  Vec<D> centre;
  double radius = 1;
};

/// A box with spheres at rest in it; lateral sides are all walls or all periodic.
template <int D>
struct Bed {
  Vec<D> size = Vec<D>::Constant(16);
  bool periodic = false;
  std::vector<Sphere<D>> spheres;

  Bed& add(const Vec<D>& centre, double radius = 1) {
    spheres.push_back({centre, radius});
    return *this;
  }

  /// The same bed in a unit of length that is smaller by `factor`.
  [[nodiscard]] Bed scaled(double factor) const {
    Bed other = *this;
    other.size *= factor;
    for (Sphere<D>& s : other.spheres)
      s = {s.centre * factor, s.radius * factor};
    return other;
  }
};

/// What was seen of one descent. Overlaps are shares of the smaller radius.
template <int D>
struct Watched {
  bool stable = false;
  Vec<D> end = Vec<D>::Zero();
  int events = 0;
  double rise = 0;         ///< highest step upwards between two events, in radii
  double overlap = 0;      ///< deepest at any event
  double last_overlap = 0; ///< deepest at the end
  double free = 1;         ///< free_descent of the contacts at the end
};

/// More events than any descent of these tests needs: a descent that reaches it would not end.
inline constexpr int kEndless = 20000;

/// Largest gap of a contact, in the smaller radius, when a resting sphere is judged.
inline constexpr double kContactGap = 1e-9;

/// Largest overlap that is promised, and the largest rise that counts as rounding: a rolling sphere is put back onto
/// what it touches, which the tolerance of contacts may have let it sink into.
inline constexpr double kPromisedOverlap = 1e-10;
inline constexpr double kRounding = kTouch;

/// Classes of the grid as drop-and-roll makes them.
template <int D>
std::vector<SizeClass> classes_of(const Bed<D>& bed, double radius) {
  double largest = radius;
  double smallest = radius;
  for (const Sphere<D>& s : bed.spheres) {
    largest = std::max(largest, s.radius);
    smallest = std::min(smallest, s.radius);
  }
  std::vector<SizeClass> classes;
  for (double top = largest; top >= smallest; top /= 4)
    classes.push_back({top, static_cast<double>(bed.spheres.size() + 1)});
  return classes;
}

/// Calls f(gap / smaller radius, unit normal into the sphere) for the faces of the box and for every sphere of the bed
/// in each of its nearest images.
template <int D, class F>
void for_each_gap(const Bed<D>& bed, const Vec<D>& p, double radius, F&& f) {
  f((p[vertical<D>] - radius) / radius, Vec<D>(Vec<D>::Unit(vertical<D>)));
  for (int a = 0; a < D - 1 && !bed.periodic; ++a) {
    f((p[a] - radius) / radius, Vec<D>(Vec<D>::Unit(a)));
    f((bed.size[a] - radius - p[a]) / radius, Vec<D>(-Vec<D>::Unit(a)));
  }
  for (const Sphere<D>& s : bed.spheres) {
    Vec<D> nearest = s.centre;
    for (int a = 0; a < D - 1 && bed.periodic; ++a)
      nearest[a] += std::round((p[a] - s.centre[a]) / bed.size[a]) * bed.size[a];
    const int images = !bed.periodic ? 1 : (D == 2 ? 3 : 9);
    for (int i = 0; i < images; ++i) {
      const int row = i / 3;
      Vec<D> q = nearest;
      if (bed.periodic) {
        q[0] += (i % 3 - 1) * bed.size[0];
        if (D == 3)
          q[1] += (row - 1) * bed.size[1];
      }
      f(((p - q).norm() - s.radius - radius) / std::min(s.radius, radius), Vec<D>((p - q).normalized()));
    }
  }
}

/// Drops a sphere from p and looks at it after every event.
template <int D>
Watched<D> watch(const Bed<D>& bed, Vec<D> p, double radius) {
  std::array<bool, D> periodic{};
  std::fill(periodic.begin(), periodic.end() - 1, bed.periodic);
  HierarchicalGrid<D> grid(bed.size, periodic, classes_of(bed, radius));
  for (const Sphere<D>& s : bed.spheres)
    grid.insert(s.centre, s.radius);

  Watched<D> seen;
  Descent<D> descent(bed.size, periodic, grid);
  descent.begin(p, radius);
  std::optional<typename Descent<D>::End> end;
  while (!end && ++seen.events < kEndless) {
    end = descent.advance();
    const Vec<D>& next = descent.position();
    seen.rise = std::max(seen.rise, (next[vertical<D>] - p[vertical<D>]) / radius);
    p = next;
    seen.last_overlap = 0;
    for_each_gap(bed, p, radius, [&](double gap, const Vec<D>&) {
      // not max(), which would lose a NaN
      if (!(-gap <= seen.last_overlap))
        seen.last_overlap = -gap;
    });
    if (!(seen.last_overlap <= seen.overlap))
      seen.overlap = seen.last_overlap;
  }
  seen.stable = end == Descent<D>::End::stable;
  seen.end = p;
  std::vector<Vec<D>> normals;
  for_each_gap(bed, p, radius, [&](double gap, const Vec<D>& normal) {
    if (gap <= kContactGap)
      normals.push_back(normal);
  });
  seen.free = free_descent<D>(normals);
  return seen;
}

/// What every descent must show, however hard its geometry.
template <int D>
void check(const Watched<D>& seen) {
  CHECK(seen.events < kEndless);
  CHECK(seen.stable);
  CHECK(seen.end.allFinite());
  CHECK(seen.rise <= kRounding);
  CHECK(seen.overlap <= kPromisedOverlap);
  CHECK(seen.free <= kContactGap);
}

/// Drops a sphere in this unit and others and checks everything that holds whatever the geometry. Powers of two round
/// nothing, so that they must give the very same bytes; other factors round the input, so that a sphere may come down
/// on the other side of a ridge, but not otherwise badly. Returns where it came to rest.
template <int D>
Vec<D> drop(const Bed<D>& bed, const Vec<D>& p, double radius = 1) {
  INFO("from " << p.transpose() << ", radius " << radius);
  const Watched<D> seen = watch(bed, p, radius);
  {
    INFO("to " << seen.end.transpose());
    check(seen);
  }
  for (const double factor : {0x1p-30, 0x1p+40}) {
    const Watched<D> other = watch(bed.scaled(factor), Vec<D>(p * factor), radius * factor);
    CHECK(other.end == seen.end * factor);
    CHECK(other.events == seen.events);
  }
  for (const double factor : {1e-6, 1e6}) {
    INFO("in units of " << factor);
    check(watch(bed.scaled(factor), Vec<D>(p * factor), radius * factor));
  }
  return seen.end;
}

} // namespace tamp::test
