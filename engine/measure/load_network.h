// Contact forces that carry the weight of all spheres at once, as nearly as pushing contacts with Coulomb's friction
// can.
#pragma once

#include "engine/base/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tamp {

/// Two spheres, or a sphere and a wall. `normal` is the unit vector from i to j, or into the wall.
template <int D>
struct LoadContact {
  static constexpr std::uint32_t kWall = 0xffffffff;
  std::uint32_t i;
  std::uint32_t j; ///< kWall: no sphere
  Vec<D> normal;
};

/// Turning moment: one number in 2D.
template <int D>
using Moment = Vec<D == 2 ? 1 : 3>;

/// When to stop. Residuals are in mean weights.
struct LoadTolerance {
  double balanced = 1e-5;    ///< rms residual at which all is balanced
  double optimal = 1e-5;     ///< largest violation of the conditions of the optimum, in forces
  std::int64_t steps = 4000; ///< at most
};

template <int D>
struct LoadNetwork {
  std::vector<Vec<D>> forces;    ///< of each contact on j (on the wall), in mean weights
  std::vector<Vec<D>> residual;  ///< net force on each sphere, its weight included
  std::vector<Moment<D>> moment; ///< net moment over the radius; zeros without friction
  double violation = 0;          ///< of the conditions of the optimum at the end, in mean weights
  std::int64_t steps = 0;
};

/// Minimises ½ Σ |net force|² + ½ Σ |net moment / radius|² over contact forces F with F·n ≥ 0 and |F − (F·n) n| ≤ μ
/// F·n: a second-order cone program, for μ = 0 non-negative least squares. `weights`: of each sphere, along
/// −e_vertical, with a mean above 0. At the optimum the residual is the motion, which no contact forbids, by which the
/// packing would begin to give way. Accelerated projected gradients (Beck & Teboulle, SIAM J. Imaging Sci. 2, 183
/// (2009)) with restarts (O'Donoghue & Candès, Found. Comput. Math. 15, 715 (2015)), each contact with the step that
/// its neighbours allow. The same bits on any number of threads.
template <int D>
LoadNetwork<D> carry_load(std::span<const LoadContact<D>> contacts, std::span<const double> weights, double mu,
                          const LoadTolerance& tolerance = {});

} // namespace tamp
