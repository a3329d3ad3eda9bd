// A grid of cells per size class, filled sphere by sphere: finds the spheres near a point at a cost that does not grow
// with their number or with their size ratio.
#pragma once

#include "engine/base/vec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace tamp {

/// One size class of a grid: spheres up to this radius that no smaller class holds, about `expected` of them to begin
/// with: where more come, the cells are made smaller.
struct SizeClass {
  double largest = 0;
  double expected = 0;
};

/// Edge of a cell as a share of the mean distance of its spheres. Measured on lognormal and bimodal powders: from 1 to
/// 1.4 the time of drop-and-roll changes by less than its noise; finer cells cost more than they save.
inline constexpr double kCellPerSpacing = 1.2;

/// Members of a class per expected one at which its cells are made anew, for as many times more.
inline constexpr double kOutgrown = 2;

/// ⌊x⌋ without the library call that std::floor is on machines of every age.
inline std::int64_t floor_index(double x) {
  const auto i = static_cast<std::int64_t>(x);
  return i - static_cast<std::int64_t>(x < static_cast<double>(i));
}

/// Spheres in a box [0, size]; lateral axes are bounded or periodic, the vertical one is always bounded. Not
/// thread-safe while it is being filled.
template <int D>
class HierarchicalGrid {
public:
  /// Classes in any order; together they must cover every radius that will be inserted. Lengths in one unit.
  HierarchicalGrid(const Vec<D>& size, const std::array<bool, D>& periodic, std::span<const SizeClass> classes) {
    assert(!periodic[vertical<D>]);
    for (const SizeClass& c : classes)
      levels_.emplace_back(size, periodic, c);
  }

  /// Adds a sphere; its centre must lie in the box.
  void insert(const Vec<D>& centre, double radius) {
    Level* home = nullptr;
    for (Level& level : levels_) {
      if (radius <= level.largest && (home == nullptr || level.largest < home->largest))
        home = &level;
    }
    home->insert(centre, radius);
  }

  /// Calls f(centre, radius) for every sphere whose surface is within `reach` of p: |centre − p| ≤ radius + reach.
  /// On periodic axes f gets the centre of each image that is that near.
  template <class F>
  void for_each_near(const Vec<D>& p, double reach, F&& f) const {
    for_each_ahead(p, reach, 0, f);
  }

  /// The same for a body of radius `reach` that from p goes any way of at most `travel` but never up: spheres too high
  /// to be touched may be left out.
  template <class F>
  void for_each_ahead(const Vec<D>& p, double reach, double travel, F&& f) const {
    for (const Level& level : levels_) {
      if (!level.nodes.empty())
        level.visit(p, reach, travel, f);
    }
  }

  /// Calls f(centre, radius) for the spheres that a body falling straight down from p could meet: those whose centres
  /// lie within radius + reach of its vertical line, column of cells by column, each from the top down. f returns the
  /// height of the body where it is stopped by what it has met so far, which starts at `stopped_at`; spheres that
  /// could only stop it lower are left out.
  template <class F>
  void for_each_below(const Vec<D>& p, double reach, double stopped_at, F&& f) const {
    for (const Level& level : levels_) {
      if (level.nodes.empty())
        continue;
      const double touching = reach + level.largest;
      // Its own column first: what it finds there spares the others the way down to the floor.
      level.template visit_columns<0>(p, reach, touching * touching, true, stopped_at, 0, Vec<D>::Zero(), f);
      level.template visit_columns<0>(p, reach, touching * touching, false, stopped_at, 0, Vec<D>::Zero(), f);
    }
  }

private:
  struct Node {
    Vec<D> centre;
    double radius;
  };

  /// The spheres of a cell are neighbours in memory too: a look at a cell costs one or two cache lines, not one a
  /// sphere. The room of a run is the power of two that holds it, at least kSmallestRun.
  struct Cell {
    std::uint32_t begin = 0;
    std::uint32_t count = 0;
  };
  static constexpr std::uint32_t kSmallestRun = 2;

  /// One size class: cells at least as wide as its largest sphere, in columns from the floor up, each a run of nodes.
  struct Level {
    double largest;
    Vec<D> size;
    std::array<bool, D> periodic;
    std::array<std::int64_t, D> cells{}; // along each axis
    Vec<D> edge, inverse_edge;
    std::vector<Cell> grid;        // column by column
    std::vector<std::int32_t> top; // of each column: its highest cell that holds anything, −1 for none
    std::vector<Node> nodes;
    std::array<std::vector<std::uint32_t>, 32> given_up; // runs that were outgrown, by the logarithm of their room
    std::size_t members = 0;
    std::size_t capacity = 0; // members for which the cells are small enough

    Level(const Vec<D>& box, const std::array<bool, D>& wraps, const SizeClass& c)
        : largest(c.largest), size(box), periodic(wraps) {
      make_cells(c.expected);
    }

    /// Empty cells, not more than a few a sphere: a class with few members gets cells nearly as wide as their mean
    /// distance.
    void make_cells(double expected) {
      const double spacing = std::pow(size.prod() / std::max(1.0, expected), 1.0 / D);
      const double target = std::max(2 * largest, kCellPerSpacing * spacing);
      std::size_t total = 1;
      for (int a = 0; a < D; ++a) {
        const auto n = static_cast<std::size_t>(a);
        cells[n] = std::max<std::int64_t>(1, static_cast<std::int64_t>(size[a] / target));
        edge[a] = size[a] / static_cast<double>(cells[n]);
        inverse_edge[a] = 1 / edge[a];
        total *= static_cast<std::size_t>(cells[n]);
      }
      grid.assign(total, {});
      top.assign(total / static_cast<std::size_t>(cells[vertical<D>]), -1);
      const bool finest = target <= 2 * largest;
      capacity = finest ? std::numeric_limits<std::size_t>::max()
                        : static_cast<std::size_t>(kOutgrown * std::max(1.0, expected));
    }

    /// Smaller cells for more members.
    void refine() {
      const std::vector<Cell> outgrown = std::exchange(grid, {});
      const std::vector<Node> members_so_far = std::exchange(nodes, {});
      given_up = {};
      make_cells(kOutgrown * static_cast<double>(members));
      for (const Cell& cell : outgrown) {
        for (std::uint32_t i = cell.begin; i < cell.begin + cell.count; ++i)
          put(members_so_far[i]);
      }
    }

    void insert(const Vec<D>& centre, double radius) {
      put({centre, radius});
      if (++members > capacity)
        refine();
    }

    void put(const Node& node) {
      std::size_t column = 0;
      std::int64_t i = 0;
      for (int a = 0; a < D; ++a) {
        const auto n = static_cast<std::size_t>(a);
        i = std::clamp<std::int64_t>(static_cast<std::int64_t>(node.centre[a] * inverse_edge[a]), 0, cells[n] - 1);
        if (a != vertical<D>)
          column = column * static_cast<std::size_t>(cells[n]) + static_cast<std::size_t>(i);
      }
      top[column] = std::max(top[column], static_cast<std::int32_t>(i));
      Cell& home = grid[column * static_cast<std::size_t>(cells[vertical<D>]) + static_cast<std::size_t>(i)];
      if (home.count == 0 || (home.count >= kSmallestRun && std::has_single_bit(home.count)))
        grow(home);
      nodes[home.begin + home.count++] = node;
    }

    /// Moves a full run to one of twice its room.
    void grow(Cell& cell) {
      const std::uint32_t room = cell.count == 0 ? kSmallestRun : 2 * cell.count;
      auto& reusable = given_up[static_cast<std::size_t>(std::countr_zero(room))];
      std::uint32_t begin = static_cast<std::uint32_t>(nodes.size());
      if (reusable.empty()) {
        nodes.resize(nodes.size() + room);
      } else {
        begin = reusable.back();
        reusable.pop_back();
      }
      std::copy_n(nodes.begin() + cell.begin, cell.count, nodes.begin() + begin);
      if (cell.count > 0)
        given_up[static_cast<std::size_t>(std::countr_zero(cell.count))].push_back(cell.begin);
      cell.begin = begin;
    }

    using Slices = std::array<std::pair<std::int64_t, std::int64_t>, D>; // first and last along each axis

    template <class F>
    void visit(const Vec<D>& p, double reach, double travel, F& f) const {
      const double touching = reach + largest;
      const double furthest = touching + travel;
      Slices all;
      for (std::size_t a = 0; a < D; ++a)
        all[a] = slices(a, p, furthest);
      // Nothing whose centre is higher than this can be touched by a body that goes down.
      auto& highest = all[vertical<D>].second;
      highest = std::min(highest, slices(vertical<D>, p, touching).second);
      visit_axis<0>(p, furthest * furthest, reach + travel, all, 0, Vec<D>::Zero(), f);
    }

    /// Walks the slices of lateral axis A that the ball reaches, `room` being what the axes before left of its squared
    /// radius; then the column.
    template <int A, class F>
    void visit_axis(const Vec<D>& p, double room, double reach, const Slices& all, std::size_t base, Vec<D> shift,
                    F& f) const {
      if constexpr (A == vertical<D>) {
        visit_column(p, reach, all[A], base, shift, f);
      } else {
        for (auto [i, last] = all[A]; i <= last; ++i) {
          const double left = room_left(i, A, p, room);
          if (left < 0)
            continue;
          const std::size_t column =
              base * static_cast<std::size_t>(cells[A]) + static_cast<std::size_t>(wrap(i, A, shift));
          visit_axis<A + 1>(p, left, reach, all, column, shift, f);
        }
      }
    }

    template <class F>
    void visit_column(const Vec<D>& p, double reach, std::pair<std::int64_t, std::int64_t> heights, std::size_t column,
                      const Vec<D>& shift, F& f) const {
      const Cell* cell = grid.data() + column * static_cast<std::size_t>(cells[vertical<D>]);
      const std::int64_t highest = std::min<std::int64_t>(heights.second, top[column]);
      for (std::int64_t i = heights.first; i <= highest; ++i) {
        const Node* node = nodes.data() + cell[i].begin;
        for (const Node* end = node + cell[i].count; node != end; ++node) {
          const Vec<D> centre = node->centre + shift;
          const double limit = node->radius + reach;
          if ((centre - p).squaredNorm() <= limit * limit)
            f(centre, node->radius);
        }
      }
    }

    /// Walks the columns of cells around the vertical line through p, axis A and those behind it still to be chosen:
    /// either the one that the line runs through, or all the others. `room` is what the chosen axes left of the squared
    /// distance at which a sphere still touches.
    template <int A, class F>
    void visit_columns(const Vec<D>& p, double reach, double room, bool own, double& stopped_at, std::size_t base,
                       Vec<D> shift, F& f, bool on_line = true) const {
      if constexpr (A == vertical<D>) {
        if (own == on_line)
          descend(p, reach, std::sqrt(room), stopped_at, base, shift, f);
      } else {
        const std::int64_t middle = slices(A, p, 0).first;
        for (auto [i, last] = own ? std::pair(middle, middle) : slices(A, p, std::sqrt(room)); i <= last; ++i) {
          const double left = std::max(0.0, room_left(i, A, p, room));
          const std::size_t column =
              base * static_cast<std::size_t>(cells[A]) + static_cast<std::size_t>(wrap(i, A, shift));
          visit_columns<A + 1>(p, reach, left, own, stopped_at, column, shift, f, on_line && i == middle);
        }
      }
    }

    /// One column of cells from the height of p downwards, while its spheres can stop the body above `stopped_at`: the
    /// body's centre comes to rest at most `lift` above theirs.
    template <class F>
    void descend(const Vec<D>& p, double reach, double lift, double& stopped_at, std::size_t column,
                 const Vec<D>& shift, F& f) const {
      constexpr int z = vertical<D>;
      const Cell* cell = grid.data() + column * static_cast<std::size_t>(cells[z]);
      const std::int64_t topmost = cells[z] - 1;
      auto i = std::clamp<std::int64_t>(floor_index(p[z] * inverse_edge[z]), 0, topmost);
      for (i = std::min<std::int64_t>(i, top[column]); i >= 0; --i) {
        const double ceiling = static_cast<double>(i + 1) * edge[z];
        if (ceiling + lift <= stopped_at && i < topmost)
          return;
        const Node* node = nodes.data() + cell[i].begin;
        for (const Node* end = node + cell[i].count; node != end; ++node) {
          const Vec<D> centre = node->centre + shift;
          const double limit = node->radius + reach;
          if ((centre - p).template head<D - 1>().squaredNorm() < limit * limit)
            stopped_at = f(centre, node->radius);
        }
      }
    }

    /// First and last slice of cells along an axis within `half` of p; on a bounded axis at least one.
    [[nodiscard]] std::pair<std::int64_t, std::int64_t> slices(std::size_t axis, const Vec<D>& p, double half) const {
      const auto a = static_cast<Eigen::Index>(axis);
      const auto first = floor_index((p[a] - half) * inverse_edge[a]);
      const auto last = floor_index((p[a] + half) * inverse_edge[a]);
      if (periodic[axis])
        return {first, last};
      return {std::clamp<std::int64_t>(first, 0, cells[axis] - 1), std::clamp<std::int64_t>(last, 0, cells[axis] - 1)};
    }

    /// What is left of a squared distance to p after the gap along an axis to slice i. Slices at the border of a
    /// bounded axis also hold what rounding or a missing lid put beyond it, so their gap is no bound.
    [[nodiscard]] double room_left(std::int64_t i, std::size_t axis, const Vec<D>& p, double room) const {
      if (!periodic[axis] && (i == 0 || i == cells[axis] - 1))
        return room;
      const auto a = static_cast<Eigen::Index>(axis);
      const double low = static_cast<double>(i) * edge[a] - p[a];
      const double gap = std::max({0.0, low, -(low + edge[a])});
      return room - gap * gap;
    }

    /// The cell that slice i means, and in `shift` the image it stands for on a periodic axis.
    std::int64_t wrap(std::int64_t i, std::size_t axis, Vec<D>& shift) const {
      if (!periodic[axis])
        return i;
      const std::int64_t turns = (i >= 0 ? i : i - cells[axis] + 1) / cells[axis];
      const auto a = static_cast<Eigen::Index>(axis);
      shift[a] = static_cast<double>(turns) * size[a];
      return i - turns * cells[axis];
    }
  };

  std::vector<Level> levels_;
};

} // namespace tamp
