// Which contacts carry a sphere: the projection of gravity on the cone of directions its contacts leave free.
#pragma once

#include "engine/base/vec.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

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
  double margin = 0; ///< smallest push of a member (see presses)
  Vec<D> velocity = Vec<D>::Zero();
};

/// Solves for the multipliers of the members, λ_i = push_i / det by Cramer's rule; false where the normals are
/// dependent or one of them would have to pull. The sign is judged on push_i, whose rounding does not grow as the
/// normals become dependent.
template <int D, class Normals>
bool presses(const Normals& normals, Support<D>& support) {
  const auto n = [&](int i) -> const Vec<D>& { return normals[support.member[static_cast<std::size_t>(i)]]; };
  std::array<double, D> push{};
  double det = 1;
  if (support.count == 1) {
    push[0] = n(0)[vertical<D>];
  } else if (support.count == 2) {
    // Gram system [1 g; g 1] λ = (n_1z, n_2z)
    const double g = n(0).dot(n(1));
    det = (1 - g) * (1 + g);
    push[0] = n(0)[vertical<D>] - g * n(1)[vertical<D>];
    push[1] = n(1)[vertical<D>] - g * n(0)[vertical<D>];
  } else if constexpr (D == 3) {
    if (support.count == 3) {
      // Σ λ_i n_i = e_z
      const Vec<D> n01 = n(0).cross(n(1));
      det = n01.dot(n(2));
      const double sign = det < 0 ? -1 : 1;
      det = std::abs(det);
      push[0] = sign * n(1).cross(n(2))[2];
      push[1] = sign * n(2).cross(n(0))[2];
      push[2] = sign * n01[2];
    }
  }
  if (det < kIndependent)
    return false;
  support.velocity = -Vec<D>::Unit(vertical<D>);
  support.margin = std::numeric_limits<double>::infinity();
  for (int i = 0; i < support.count; ++i) {
    const double p = push[static_cast<std::size_t>(i)];
    if (p < -kDirection)
      return false;
    support.margin = std::min(support.margin, p);
    support.velocity += (p / det) * n(i);
  }
  if (support.count == D)
    support.velocity.setZero();
  return true;
}

/// Whether every member presses by more than rounding; a support that is not firm only just holds.
template <int D>
bool is_firm(const Support<D>& support) {
  return support.margin > kDirection;
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
