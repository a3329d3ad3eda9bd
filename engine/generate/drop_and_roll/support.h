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

/// Normals whose determinant, or two whose cross product, is below this are taken as dependent; smaller sets of them
/// then decide.
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

/// Whether no member would have to pull, and with it the velocity that they leave; false where the normals are
/// dependent. The sign of a multiplier is judged on `push`, a positive multiple of it whose rounding does not grow as
/// the normals become dependent.
template <int D, class Normals>
bool presses(const Normals& normals, Support<D>& support) {
  const auto n = [&](int i) -> const Vec<D>& { return normals[support.member[static_cast<std::size_t>(i)]]; };
  std::array<double, D> push{};
  double independence = 1;
  support.velocity.setZero();
  if (support.count == 1) {
    push[0] = n(0)[vertical<D>];
    support.velocity = push[0] * n(0) - Vec<D>::Unit(vertical<D>);
  } else if constexpr (D == 2) {
    // Σ λ_i n_i = e_z by Cramer's rule
    const double det = n(0)[0] * n(1)[1] - n(0)[1] * n(1)[0];
    const double sign = det < 0 ? -1 : 1;
    independence = std::abs(det);
    push = {-sign * n(1)[0], sign * n(0)[0]};
  } else {
    const Vec<D> n01 = n(0).cross(n(1));
    if (support.count == 2) {
      // λ_i ∝ n_iz − (n_0·n_1) n_jz, as triple products, which do not cancel where the normals nearly agree
      independence = n01.norm();
      push = {n(1).cross(n01)[2], n01.cross(n(0))[2], 0};
      support.velocity = n01 * (-n01[2] / (independence * independence));
    } else {
      const double det = n01.dot(n(2));
      const double sign = det < 0 ? -1 : 1;
      independence = std::abs(det);
      push = {sign * n(1).cross(n(2))[2], sign * n(2).cross(n(0))[2], sign * n01[2]};
    }
  }
  support.margin = *std::min_element(push.begin(), push.begin() + support.count);
  return independence >= kIndependent && support.margin >= -kDirection;
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
