// A grid of cells per size class, filled sphere by sphere: finds the spheres near a point at a cost that does not grow
// with their number or with their size ratio.
#pragma once

#include "engine/base/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tamp {

/// One size class of a grid: spheres up to this radius that no smaller class holds, about `expected` of them.
struct SizeClass {
  double largest = 0;
  double expected = 0;
};

/// Edge of a cell as a share of the mean distance of its spheres. Measured on the lognormal powder: from 0.5 to 1 the
/// time of drop-and-roll changes by less than its noise; finer cells cost more than they save.
inline constexpr double kCellPerSpacing = 0.7;

/// ⌊x⌋ without the library call that std::floor is on machines of every age.
inline std::int64_t floor_index(double x) {
  const auto i = static_cast<std::int64_t>(x);
  return i - static_cast<std::int64_t>(x < static_cast<double>(i));
}

/// Spheres in a box [0, size]; axes are bounded or periodic. Not thread-safe while it is being filled.
template <int D>
class HierarchicalGrid {
public:
  /// Classes in any order; together they must cover every radius that will be inserted. Lengths in one unit.
  HierarchicalGrid(const Vec<D>& size, const std::array<bool, D>& periodic, std::span<const SizeClass> classes) {
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
    for (const Level& level : levels_) {
      if (!level.nodes.empty())
        level.visit(p, reach, f);
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
      Vec<D> shift = Vec<D>::Zero();
      const double touching = reach + level.largest;
      level.template visit_columns<D - 2>(p, reach, touching * touching, stopped_at, {}, shift, f);
    }
  }

private:
  struct Node {
    Vec<D> centre;
    double radius;
  };

  /// The spheres of a cell are neighbours in memory too: a look at a cell costs one or two cache lines, not one a
  /// sphere.
  struct Cell {
    std::uint32_t begin = 0;
    std::uint32_t count = 0;
    std::uint32_t capacity = 0;
  };

  /// One size class: cells at least as wide as its largest sphere, each a run of nodes with room to grow.
  struct Level {
    double largest;
    Vec<D> size;
    std::array<bool, D> periodic;
    std::array<std::int64_t, D> cells{}; // along each axis
    Vec<D> edge, inverse_edge;
    std::vector<Cell> grid;
    std::vector<Node> nodes; // runs that outgrew their room were copied to the end; their old places stay unused

    Level(const Vec<D>& box, const std::array<bool, D>& wraps, const SizeClass& c)
        : largest(c.largest), size(box), periodic(wraps) {
      // Not more than a few cells a sphere: a class with few members gets cells nearly as wide as their mean distance.
      const double spacing = std::pow(box.prod() / std::max(1.0, c.expected), 1.0 / D);
      const double target = std::max(2 * c.largest, kCellPerSpacing * spacing);
      std::size_t total = 1;
      for (int a = 0; a < D; ++a) {
        const auto n = static_cast<std::size_t>(a);
        cells[n] = std::max<std::int64_t>(1, static_cast<std::int64_t>(box[a] / target));
        edge[a] = box[a] / static_cast<double>(cells[n]);
        inverse_edge[a] = 1 / edge[a];
        total *= static_cast<std::size_t>(cells[n]);
      }
      grid.resize(total);
    }

    void insert(const Vec<D>& centre, double radius) {
      std::size_t cell = 0;
      for (int a = D - 1; a >= 0; --a) {
        const auto n = static_cast<std::size_t>(a);
        const auto i =
            std::clamp<std::int64_t>(static_cast<std::int64_t>(centre[a] * inverse_edge[a]), 0, cells[n] - 1);
        cell = cell * static_cast<std::size_t>(cells[n]) + static_cast<std::size_t>(i);
      }
      Cell& home = grid[cell];
      if (home.count == home.capacity)
        move_to_end(home);
      nodes[home.begin + home.count++] = {centre, radius};
    }

    void move_to_end(Cell& cell) {
      const auto begin = static_cast<std::uint32_t>(nodes.size());
      cell.capacity = std::max(2U, 2 * cell.capacity);
      nodes.resize(nodes.size() + cell.capacity);
      std::copy_n(nodes.begin() + cell.begin, cell.count, nodes.begin() + begin);
      cell.begin = begin;
    }

    template <class F>
    void visit(const Vec<D>& p, double reach, F& f) const {
      const double radius = reach + largest;
      visit_axis<D - 1>(p, reach, radius * radius, 0, Vec<D>::Zero(), f);
    }

    /// Walks the cells of axis A that the ball reaches, `room` being what the axes above left of its squared radius.
    template <int A, class F>
    void visit_axis(const Vec<D>& p, double reach, double room, std::size_t base, Vec<D> shift, F& f) const {
      for (auto [i, last] = slices(A, p, std::sqrt(room)); i <= last; ++i) {
        const std::size_t cell =
            base * static_cast<std::size_t>(cells[A]) + static_cast<std::size_t>(wrap(i, A, shift));
        if constexpr (A == 0) {
          visit_cell(cell, p, reach, shift, f);
        } else {
          const double left = room_left(i, A, p, room);
          if (left >= 0)
            visit_axis<A - 1>(p, reach, left, cell, shift, f);
        }
      }
    }

    template <class F>
    void visit_cell(std::size_t cell, const Vec<D>& p, double reach, const Vec<D>& shift, F& f) const {
      const Node* node = nodes.data() + grid[cell].begin;
      for (const Node* end = node + grid[cell].count; node != end; ++node) {
        const Vec<D> centre = node->centre + shift;
        const double limit = node->radius + reach;
        if ((centre - p).squaredNorm() <= limit * limit)
          f(centre, node->radius);
      }
    }

    /// Walks the columns of cells around the vertical line through p, axis A and below still to be chosen; `room` is
    /// what the chosen axes left of the squared distance at which a sphere still touches.
    template <int A, class F>
    void visit_columns(const Vec<D>& p, double reach, double room, double& stopped_at,
                       std::array<std::int64_t, D> index, Vec<D>& shift, F& f) const {
      for (auto [i, last] = slices(A, p, std::sqrt(room)); i <= last; ++i) {
        const double left = std::max(0.0, room_left(i, A, p, room));
        index[A] = wrap(i, A, shift);
        if constexpr (A == 0) {
          descend(p, reach, std::sqrt(left), stopped_at, index, shift, f);
        } else {
          visit_columns<A - 1>(p, reach, left, stopped_at, index, shift, f);
        }
      }
    }

    /// One column of cells from the height of p downwards, while its spheres can stop the body above `stopped_at`: the
    /// body's centre comes to rest at most `lift` above theirs.
    template <class F>
    void descend(const Vec<D>& p, double reach, double lift, double& stopped_at, std::array<std::int64_t, D> index,
                 const Vec<D>& shift, F& f) const {
      constexpr int z = vertical<D>;
      const std::int64_t topmost = cells[z] - 1;
      for (index[z] = std::clamp<std::int64_t>(floor_index(p[z] * inverse_edge[z]), 0, topmost); index[z] >= 0;
           --index[z]) {
        const double top = static_cast<double>(index[z] + 1) * edge[z];
        if (top + lift <= stopped_at && index[z] < topmost)
          return;
        std::size_t cell = 0;
        for (std::size_t a = D; a-- > 0;) {
          cell = cell * static_cast<std::size_t>(cells[a]) + static_cast<std::size_t>(index[a]);
        }
        const Node* node = nodes.data() + grid[cell].begin;
        for (const Node* end = node + grid[cell].count; node != end; ++node) {
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
