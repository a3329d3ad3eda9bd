// Which contacts carry a sphere: the projection of gravity on the cone of directions its contacts leave free.
#pragma once

#include "engine/base/vec.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tamp {

/// Tolerance on direction cosines and on contact multipliers of unit normals: rounding of normals is 1e-16 times the
/// ratio of a box edge to a radius.
inline constexpr double kDirection = 1e-11;

/// Normals whose determinant is below this are taken as dependent; smaller sets of them then decide.
inline constexpr double kIndependent = 1e-9;

/// Up to D contacts pressed on by gravity. The free velocity is v = −e_z + Σ λ_i n_i with v·n_i = 0 for the chosen
/// contacts: the projection of −e_z on the cone {v : v·n_j ≥ 0} when all λ_i ≥ 0 and all other v·n_j ≥ 0
/// (Karush–Kuhn–Tucker conditions of min |v + e_z|²).
template <int D>
struct Support {
  std::array<std::size_t, D> member{}; ///< indices into the list of touching contacts
  int count = 0;
  std::array<double, D> lambda{};
  Vec<D> velocity = Vec<D>::Zero();
};

/// Solves for the multipliers of the members; false where the normals are dependent or one of them would have to pull.
template <int D, class Normals>
bool presses(const Normals& normals, Support<D>& support) {
  Vec<D> v = Vec<D>::Zero();
  v[vertical<D>] = -1;
  const auto n = [&](int i) -> const Vec<D>& { return normals[support.member[static_cast<std::size_t>(i)]]; };
  const auto store = [&](int i, double value) { support.lambda[static_cast<std::size_t>(i)] = value; };

  if (support.count == 1) {
    store(0, n(0)[vertical<D>]);
  } else if (support.count == 2) {
    // Gram system [1 g; g 1] λ = (n1z, n2z)
    const double g = n(0).dot(n(1));
    const double det = (1 - g) * (1 + g);
    if (det < kIndependent)
      return false;
    const double z0 = n(0)[vertical<D>];
    const double z1 = n(1)[vertical<D>];
    store(0, (z0 - g * z1) / det);
    store(1, (z1 - g * z0) / det);
  } else if constexpr (D == 3) {
    if (support.count == 3) {
      // Cramer's rule for Σ λ_i n_i = e_z
      const double det = n(0).dot(n(1).cross(n(2)));
      if (std::abs(det) < kIndependent)
        return false;
      store(0, n(1).cross(n(2))[2] / det);
      store(1, n(2).cross(n(0))[2] / det);
      store(2, n(0).cross(n(1))[2] / det);
    }
  }
  for (int i = 0; i < support.count; ++i) {
    const double lambda = support.lambda[static_cast<std::size_t>(i)];
    if (lambda < -kDirection)
      return false;
    v += lambda * n(i);
  }
  support.velocity = support.count == D ? Vec<D>(Vec<D>::Zero()) : v;
  return true;
}

/// Calls f(support) for every set of `size` of the touching contacts, in a fixed order, until f returns true.
template <int D, class F>
bool for_each_support(std::size_t touching, int size, F&& f) {
  Support<D> support;
  support.count = size;
  const auto choose = [&](auto&& self, int filled, std::size_t from) -> bool {
    if (filled == size)
      return f(support);
    for (std::size_t i = from; i < touching; ++i) {
      support.member[static_cast<std::size_t>(filled)] = i;
      if (self(self, filled + 1, i + 1))
        return true;
    }
    return false;
  };
  return choose(choose, 0, 0);
}

} // namespace tamp
