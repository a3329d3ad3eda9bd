// The skyline of a bed: for each column of the floor plan, a height below which something may lie and above which
// nothing does.
#pragma once

#include "engine/base/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tamp {

/// Columns over the D−1 lateral axes of a box; heights only grow.
template <int D>
class Skyline {
public:
  /// About `columns` columns in all; `periodic` has one flag per axis, of which the lateral ones count.
  Skyline(const Vec<D>& size, const std::array<bool, D>& periodic, double columns) : periodic_(periodic) {
    double area = 1;
    for (int a = 0; a < D - 1; ++a)
      area *= size[a];
    const double edge = std::pow(area / std::max(1.0, columns), 1.0 / (D - 1));
    std::size_t total = 1;
    for (int a = 0; a < D - 1; ++a) {
      const auto n = static_cast<std::size_t>(a);
      count_[n] = std::max<std::int64_t>(1, static_cast<std::int64_t>(size[a] / edge));
      inverse_edge_[n] = static_cast<double>(count_[n]) / size[a];
      total *= static_cast<std::size_t>(count_[n]);
    }
    height_.assign(total, 0.0);
  }

  /// Nothing in the columns within `radius` of p (laterally) reaches above this height.
  [[nodiscard]] double above(const Vec<D>& p, double radius) const {
    double top = 0;
    visit<D - 2>(p, radius, 0, [&](std::size_t column) { top = std::max(top, height_[column]); });
    return top;
  }

  /// Adds a sphere.
  void raise(const Vec<D>& centre, double radius) {
    const double top = centre[vertical<D>] + radius;
    visit<D - 2>(centre, radius, 0, [&](std::size_t column) { height_[column] = std::max(height_[column], top); });
  }

private:
  template <int A, class F>
  void visit(const Vec<D>& p, double radius, std::size_t base, F&& f) const {
    constexpr auto n = static_cast<std::size_t>(A);
    auto first = static_cast<std::int64_t>(std::floor((p[A] - radius) * inverse_edge_[n]));
    auto last = static_cast<std::int64_t>(std::floor((p[A] + radius) * inverse_edge_[n]));
    if (!periodic_[n]) {
      first = std::clamp<std::int64_t>(first, 0, count_[n] - 1);
      last = std::clamp<std::int64_t>(last, 0, count_[n] - 1);
    } else {
      last = std::min(last, first + count_[n] - 1);
    }
    for (std::int64_t i = first; i <= last; ++i) {
      const std::int64_t wrapped = ((i % count_[n]) + count_[n]) % count_[n];
      const std::size_t column = base * static_cast<std::size_t>(count_[n]) + static_cast<std::size_t>(wrapped);
      if constexpr (A == 0) {
        f(column);
      } else {
        visit<A - 1>(p, radius, column, f);
      }
    }
  }

  std::array<bool, D> periodic_;
  std::array<std::int64_t, D - 1> count_{};
  std::array<double, D - 1> inverse_edge_{};
  std::vector<double> height_;
};

} // namespace tamp
