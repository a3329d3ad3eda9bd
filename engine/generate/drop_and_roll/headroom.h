// Headroom: how large a sphere can still find a place under the lid, so that attempts which cannot succeed need no
// descent.
#pragma once

#include "engine/base/vec.h"
#include "engine/search/hierarchical_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <vector>

namespace tamp {

/// h(x), for x in the floor plan, is the radius of the largest sphere that touches the lid from below above x and
/// overlaps neither bed nor walls. A sphere that comes to rest under the lid has passed a place where it touched the
/// lid, so a radius above max h cannot succeed, however it rolls; and as the bed only grows, max h only falls.
/// Against a sphere of the bed of radius R, its centre d below the lid and s away from x, the largest tangent radius is
///   f(s) = (s² + d² − R²) / (2 (R + d)),
/// which grows with s. h is the smallest such f; its maximum is bounded tile by tile by the smallest f of a tile's
/// farthest corner, in tiles that are halved where the bound is in question.
template <int D>
class Headroom {
public:
  Headroom(const Vec<D>& size, const std::array<bool, D>& periodic, const HierarchicalGrid<D>& grid)
      : size_(size), periodic_(periodic), grid_(grid) {
    Tile plan;
    plan.bound = size[vertical<D>] / 2; // between floor and lid
    plan.centre = size.template head<D - 1>() / 2;
    plan.half = size.template head<D - 1>() / 2;
    tiles_.push(plan);
  }

  /// Whether a sphere of this radius certainly finds no place. False may also mean that the proof would have taken too
  /// long; the tiles halved on the way remain, so that the next question gets further.
  bool excludes(double radius) {
    const double limit = radius * (1 - kMargin);
    if (limit < witnessed_)
      return false;
    for (int i = 0; i < kPatience; ++i) {
      Tile tile = tiles_.top();
      if (tile.bound <= limit)
        return true;
      tiles_.pop();
      witness_ = tile.centre;
      witnessed_ = look(tile);
      if (witnessed_ > limit || tile.bound <= limit) {
        tiles_.push(tile);
        if (witnessed_ > limit)
          return false;
      } else {
        halve(tile);
      }
    }
    return false;
  }

  /// A sphere has come to rest: the largest radius known to fit may be smaller now.
  void add(const Vec<D>& centre, double radius) {
    if (witnessed_ <= 0)
      return;
    double s2 = 0;
    for (int a = 0; a < D - 1; ++a) {
      double s = std::abs(centre[a] - witness_[a]);
      if (periodic_[static_cast<std::size_t>(a)])
        s = std::min(s, std::abs(size_[a] - s));
      s2 += s * s;
    }
    witnessed_ = std::min(witnessed_, tangent(s2, size_[vertical<D>] - centre[vertical<D>], radius));
  }

private:
  using Plan = Eigen::Matrix<double, D - 1, 1>;

  /// Share of a radius by which a sphere may squeeze through a throat, its contacts being exact to kTouch; far more
  /// than that, far less than matters for the time saved.
  static constexpr double kMargin = 1e-9;

  /// Tiles looked at for one question. A look costs a search of the grid, as an event of a descent does.
  static constexpr int kPatience = 32;

  struct Tile {
    double bound = 0; ///< h is nowhere larger in the tile
    Plan centre;
    Plan half; ///< of its edges
    bool operator<(const Tile& other) const { return bound < other.bound; }
  };

  static double tangent(double s2, double depth, double radius) {
    return (s2 + (depth - radius) * (depth + radius)) / (2 * (radius + depth));
  }

  /// Renews the bound of a tile from the bed as it is now; returns h at its centre.
  double look(Tile& tile) const {
    const double lid = size_[vertical<D>];
    const double reach = tile.bound;
    const double corner = tile.half.norm();
    double here = reach;
    for (int a = 0; a < D - 1; ++a) {
      if (periodic_[static_cast<std::size_t>(a)])
        continue;
      const double wall = std::min(tile.centre[a], size_[a] - tile.centre[a]);
      here = std::min(here, wall);
      tile.bound = std::min(tile.bound, wall + tile.half[a]);
    }
    Vec<D> p;
    p << tile.centre, lid - reach;
    grid_.for_each_near(p, reach, [&](const Vec<D>& centre, double radius) {
      const double s = (centre - p).template head<D - 1>().norm();
      const double depth = lid - centre[vertical<D>];
      here = std::min(here, tangent(s * s, depth, radius));
      tile.bound = std::min(tile.bound, tangent((s + corner) * (s + corner), depth, radius));
    });
    return here;
  }

  /// Puts the halves of a tile, along every axis, in its place.
  void halve(Tile tile) {
    tile.half /= 2;
    const Plan middle = tile.centre;
    for (unsigned quarter = 0; quarter < 1U << (D - 1); ++quarter) {
      for (int a = 0; a < D - 1; ++a)
        tile.centre[a] = middle[a] + ((quarter >> a & 1U) != 0 ? tile.half[a] : -tile.half[a]);
      tiles_.push(tile);
    }
  }

  Vec<D> size_;
  std::array<bool, D> periodic_;
  const HierarchicalGrid<D>& grid_;
  std::priority_queue<Tile> tiles_;
  Plan witness_ = Plan::Zero();
  double witnessed_ = 0; ///< at most h at the witness, so this radius fits; 0 before the first question
};

} // namespace tamp
