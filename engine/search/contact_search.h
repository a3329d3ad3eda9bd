// Finds all pairs of spheres of any sizes that touch or nearly touch, and the walls they touch, at linear cost.
#pragma once

#include "engine/base/vec.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tamp {

/// A box [0, size] whose axes are periodic or bounded; a bounded axis has a wall at either, both or neither end.
template <int D>
struct SearchBox {
  Vec<D> size = Vec<D>::Ones();
  std::array<bool, D> periodic{};
  std::array<std::array<bool, 2>, D> wall{}; ///< [axis][0: at 0, 1: at size]; of no account on periodic axes
};

/// Sphere i and an image of sphere j. `normal` is the unit vector from i to j (zero if the centres coincide), `gap` the
/// distance of the surfaces, negative in an overlap.
template <int D>
struct SpherePair {
  std::size_t i;
  std::size_t j;
  Vec<D> normal;
  double gap;
};

/// Sphere i and the wall across `axis` at 0 (side 0) or at the far end (side 1).
struct WallContact {
  std::size_t i;
  int axis;
  int side;
  double gap;
};

/// The search structure over a fixed set of spheres. Spheres are sorted into levels by radius, each half the last, and
/// each level into cells as wide as its spheres; a sphere looks only at levels of its own size and larger, so small
/// spheres are never counted out around a large one.
template <int D>
class ContactSearch {
public:
  /// positions: D numbers a sphere, finite, of any place (periodic axes wrap them); radii: finite, above 0. Both must
  /// outlive the search.
  ContactSearch(const SearchBox<D>& box, std::span<const double> positions, std::span<const double> radii);

  /// Calls f(const SpherePair<D>&) once for each pair whose gap is at most max_relative_gap (≥ 0) times the smaller
  /// radius. Pairs are told apart by their image, so two spheres of a small periodic box may form several, and a sphere
  /// may pair with an image of itself (i = j: one pair stands for both ends). The order depends on the input alone.
  template <class F>
  void for_each_pair(double max_relative_gap, F&& f) const {
    std::vector<std::vector<SpherePair<D>>> found(kBlocksAtOnce);
    const std::size_t blocks = (count_ + kBlock - 1) / kBlock;
    for (std::size_t first = 0; first < blocks; first += kBlocksAtOnce) {
      collect(first, std::min(blocks - first, kBlocksAtOnce), max_relative_gap, found);
      for (auto& pairs : found) {
        for (const SpherePair<D>& pair : pairs)
          f(pair);
        pairs.clear();
      }
    }
  }

  /// Calls f(const WallContact&) for each sphere and wall whose gap is at most max_relative_gap times the radius.
  template <class F>
  void for_each_wall(double max_relative_gap, F&& f) const {
    for (std::size_t i = 0; i < count_; ++i) {
      for (int axis = 0; axis < D; ++axis) {
        for (int side = 0; side < 2; ++side) {
          const auto a = static_cast<std::size_t>(axis);
          const double x = positions_[i * D + a];
          const double gap = (side == 0 ? x : box_.size[axis] - x) - radii_[i];
          if (!box_.periodic[a] && box_.wall[a][static_cast<std::size_t>(side)] && gap <= max_relative_gap * radii_[i])
            f(WallContact{i, axis, side, gap});
        }
      }
    }
  }

private:
  static constexpr std::size_t kBlock = 1024;      // spheres of one task
  static constexpr std::size_t kBlocksAtOnce = 64; // bounds the pairs held in memory

  struct Entry {
    Vec<D> centre = Vec<D>::Zero(); // as given
    double radius = 0;
    std::size_t index = 0;
    std::array<std::int64_t, D> image{}; // periods between the box and the centre as given
  };

  struct Level {
    double largest = 0;
    std::size_t first = 0; // its entries are [first, last)
    std::size_t last = 0;
    Vec<D> origin = Vec<D>::Zero();
    Vec<D> edge = Vec<D>::Zero(); // of a cell
    std::array<std::int64_t, D> cells{};
    std::vector<std::size_t> start; // of each cell's entries; one more at the end
  };

  void lay_out(Level& level);
  [[nodiscard]] Vec<D> wrapped(const Entry& entry) const;
  [[nodiscard]] std::size_t cell_of(const Level& level, const Entry& entry) const;
  void collect(std::size_t first_block, std::size_t blocks, double max_relative_gap,
               std::vector<std::vector<SpherePair<D>>>& found) const;
  void search_level(const Entry& from, const Level& level, bool own, double max_relative_gap,
                    std::vector<SpherePair<D>>& found) const;

  SearchBox<D> box_;
  std::span<const double> positions_;
  std::span<const double> radii_;
  std::size_t count_;
  std::vector<Level> levels_;  // large spheres first
  std::vector<Entry> entries_; // by level, then by cell
};

extern template class ContactSearch<2>;
extern template class ContactSearch<3>;

} // namespace tamp
