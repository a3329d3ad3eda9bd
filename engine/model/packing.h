// Packing: what came out — spheres (or discs) in a box.
#pragma once

#include "engine/base/vec.h"
#include "engine/model/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace tamp {

enum class Boundary { wall, periodic, open };
template <>
struct EnumNames<Boundary> {
  static constexpr std::array<std::string_view, 3> value{"wall", "periodic", "open"};
};

/// Spheres in D = `dimension` dimensions. Coordinates count from the lower corner of the box, so the box is
/// [0, size_0] × … ; a sphere of a periodic axis may reach through a face and is then present on the other side too.
struct Packing {
  int dimension = 3;
  LengthUnit unit = LengthUnit::um;
  std::array<double, 3> size{};       ///< box edges; unused axes are 0
  std::array<Boundary, 3> boundary{}; ///< of both faces of an axis; the vertical axis is open when it has no lid
  std::vector<double> positions;      ///< count() × dimension numbers, one sphere after the other
  std::vector<double> radii;          ///< count() numbers

  [[nodiscard]] std::size_t count() const { return radii.size(); }

  /// Centre of sphere i; D must equal `dimension`.
  template <int D>
  [[nodiscard]] Eigen::Map<const Vec<D>> centre(std::size_t i) const {
    return Eigen::Map<const Vec<D>>(positions.data() + i * D);
  }

  /// Centre of sphere i for programs that know three dimensions only: in 2D the third coordinate is 0.
  [[nodiscard]] std::array<double, 3> centre_in_space(std::size_t i) const {
    const std::size_t first = i * static_cast<std::size_t>(dimension);
    return {positions[first], positions[first + 1], dimension == 3 ? positions[first + 2] : 0};
  }
};

/// Calls f with std::integral_constant<int, 2> or <int, 3>: the one place where the dimension becomes a type.
template <class F>
decltype(auto) with_dimension(std::int64_t dimension, F&& f) {
  if (dimension == 2)
    return f(std::integral_constant<int, 2>{});
  return f(std::integral_constant<int, 3>{});
}

} // namespace tamp
