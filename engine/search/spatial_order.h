// An order in which spheres that are near in space are near in memory.
#pragma once

#include "engine/base/vec.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace tamp {

/// Indices of the spheres sorted by the cells of a regular grid along a Morton curve, about `kSpheresPerCell` in a
/// cell; spheres of a cell keep their order. positions: D numbers each; size: the box, beyond which places count as on
/// its border.
template <int D>
std::vector<std::uint32_t> spatial_order(const Vec<D>& size, std::span<const double> positions) {
  constexpr double kSpheresPerCell = 8;
  constexpr int kMostBits = 60 / D;
  const std::size_t n = positions.size() / D;
  const double cells = std::pow(static_cast<double>(n) / kSpheresPerCell + 1, 1.0 / D);
  const int bits = std::clamp(static_cast<int>(std::ceil(std::log2(cells))), 1, kMostBits);
  const double most = std::ldexp(1.0, bits) - 1;
  std::vector<std::uint64_t> key(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t a = 0; a < D; ++a) {
      const double share = positions[i * D + a] / size[static_cast<int>(a)];
      const auto cell = static_cast<std::uint64_t>(std::clamp(share * (most + 1), 0.0, most));
      for (int bit = 0; bit < bits; ++bit)
        key[i] |= (cell >> bit & 1U) << (static_cast<std::size_t>(bit) * D + a);
    }
  }
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return key[i] < key[j]; });
  return order;
}

} // namespace tamp
