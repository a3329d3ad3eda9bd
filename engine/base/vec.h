// Small fixed-size vectors, the same code for 2D and 3D.
#pragma once

#include <Eigen/Core>

namespace tamp {

/// A point or direction in D dimensions; the last axis is the vertical one.
template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

/// Index of the vertical axis: gravity acts along −e_vertical.
template <int D>
inline constexpr int vertical = D - 1;

} // namespace tamp
