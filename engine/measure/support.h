// Whether the contacts of a sphere carry it: how freely it could still move down.
#pragma once

#include "engine/base/vec.h"

#include <span>

namespace tamp {

/// Length of the projection of −e_z on the cone {v : v·n_i ≥ 0} of motions that the contacts leave free: 0 for a sphere
/// in equilibrium, 1 for one that falls. By Moreau's decomposition it is the least |Σ λ_i n_i − e_z| over λ ≥ 0, found
/// by non-negative least squares (Lawson & Hanson 1974, ch. 23). normals: unit vectors into the sphere, one a contact.
template <int D>
double free_descent(std::span<const Vec<D>> normals);

} // namespace tamp
