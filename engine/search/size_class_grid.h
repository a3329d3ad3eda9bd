// Spheres of any sizes sorted into flat arrays of cells, one grid per size class: rebuilt as a whole in a few
// nanoseconds a sphere, and read in runs of neighbouring cells.
#pragma once

#include "engine/base/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tamp {

/// Images of a sphere in the box and its direct neighbours: digit 1 of axis a, in base 3, means no shift.
template <int D>
inline constexpr std::uint32_t kHomeImage = D == 2 ? 4 : 13;

/// Spheres around centres in [0, size] (periodic axes) or anywhere (bounded ones), each with the reach within which it
/// must be found. Level l holds reaches in (largest / 2^(l+1), largest / 2^l].
template <int D>
class SizeClassGrid {
public:
  struct Entry {
    Vec<D> centre;
    double reach;
    std::uint32_t index;
  };

  struct Level {
    double largest = 0;           ///< reach
    Vec<D> edge = Vec<D>::Ones(); ///< of a cell

    /// Calls f(entry, image) for at least every entry of an image whose centre is within `distance` of p. p must lie
    /// in the box on periodic axes, or out of it by less than the box is wider than `distance`.
    template <class F>
    void visit(const Vec<D>& p, double distance, F&& f) const {
      std::array<std::int64_t, D> low;
      std::array<std::int64_t, D> high;
      for (std::size_t a = 0; a < D; ++a) {
        const auto axis = static_cast<int>(a);
        const double from = (p[axis] - origin[axis] - distance) * inverse_edge[axis];
        const double to = (p[axis] - origin[axis] + distance) * inverse_edge[axis];
        const auto n = static_cast<double>(cells[a]);
        // Periodic axes: one period to either side at most. Bounded ones: border cells hold what lies beyond them.
        low[a] = static_cast<std::int64_t>(std::floor(std::clamp(from, periodic[a] ? -n : 0, n - 1)));
        high[a] = static_cast<std::int64_t>(std::floor(std::clamp(to, 0.0, periodic[a] ? 2 * n - 0.5 : n - 1)));
      }
      visit_axis<0>(low, high, 0, 0, f);
    }

    /// Index of the period that cell i lies in (−1, 0 or 1), as a digit 0 … 2.
    [[nodiscard]] std::int64_t period(std::int64_t i, std::size_t a) const {
      return i < 0 ? 0 : (i < cells[a] ? 1 : 2);
    }

    template <int A, class F>
    void visit_axis(const std::array<std::int64_t, D>& low, const std::array<std::int64_t, D>& high, std::int64_t base,
                    std::uint32_t image, F& f) const {
      const std::int64_t n = cells[A];
      if constexpr (A == D - 1) {
        // The cells of the last axis follow one another in memory: one run for each period.
        for (std::int64_t k = period(low[A], A); k <= period(high[A], A); ++k) {
          const std::int64_t first = std::max(low[A] - (k - 1) * n, std::int64_t{0});
          const std::int64_t last = std::min(high[A] - (k - 1) * n, n - 1);
          const Entry* e = entries.data() + start[static_cast<std::size_t>(base * n + first)];
          const Entry* end = entries.data() + start[static_cast<std::size_t>(base * n + last) + 1];
          for (; e != end; ++e)
            f(*e, image * 3 + static_cast<std::uint32_t>(k));
        }
      } else {
        for (std::int64_t i = low[A]; i <= high[A]; ++i) {
          const std::int64_t k = period(i, A);
          visit_axis<A + 1>(low, high, base * n + i - (k - 1) * n, image * 3 + static_cast<std::uint32_t>(k), f);
        }
      }
    }

    std::array<bool, D> periodic{};
    Vec<D> origin = Vec<D>::Zero();
    Vec<D> inverse_edge = Vec<D>::Ones();
    std::array<std::int64_t, D> cells{};
    std::vector<std::uint32_t> start; // of each cell's entries; one more at the end
    std::vector<Entry> entries;       // by cell
  };

  /// Sorts the spheres in. centres: D numbers each.
  void build(const Vec<D>& size, const std::array<bool, D>& periodic, std::span<const double> centres,
             std::span<const double> reaches);

  /// Large spheres first; levels without spheres are left out.
  [[nodiscard]] std::span<const Level> levels() const { return levels_; }
  /// The level of a sphere of the last build.
  [[nodiscard]] std::size_t level_of(std::size_t i) const { return level_of_[i]; }

private:
  std::vector<Level> levels_;
  std::vector<std::uint8_t> level_of_;
};

extern template class SizeClassGrid<2>;
extern template class SizeClassGrid<3>;

} // namespace tamp
