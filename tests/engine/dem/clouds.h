// Loose clouds of spheres above a floor, to be settled.
#pragma once

#include "engine/base/random.h"
#include "engine/dem/settle.h"

#include <cmath>
#include <numbers>
#include <string>

namespace tamp::test {

/// n spheres of radii from `smallest` to 1 on a jittered lattice above a square of `cells`² (2D: `cells`) places, in a
/// box of periodic or walled sides and no lid; masses are those of spheres of density 1, gravity 1.
template <int D>
SettleTask<D> cloud(std::size_t n, int cells, double smallest, bool periodic, const std::string& key) {
  constexpr double kPitch = 2.4;
  SettleTask<D> task;
  RandomStream random(key, 1);
  task.box.size = Vec<D>::Constant(cells * kPitch);
  for (std::size_t a = 0; a < D; ++a) {
    task.box.periodic[a] = periodic && a != static_cast<std::size_t>(vertical<D>);
    task.box.wall[a] = {true, a != static_cast<std::size_t>(vertical<D>)};
  }
  for (std::size_t i = 0; i < n; ++i) {
    Vec<D> c;
    std::size_t rest = i;
    for (int a = 0; a < D; ++a) {
      const auto along = a == vertical<D> ? rest : rest % static_cast<std::size_t>(cells);
      rest /= static_cast<std::size_t>(cells);
      c[a] = kPitch * (static_cast<double>(along) + 0.5) + 0.2 * (2 * random.uniform() - 1);
    }
    task.centres.push_back(c);
    task.radii.push_back(smallest + (1 - smallest) * random.uniform());
    task.masses.push_back(4.0 / 3.0 * std::numbers::pi * std::pow(task.radii.back(), 3));
  }
  task.modulus = task.largest_modulus = 2e4;
  task.overlap = 0.05;
  return task;
}

/// Whether all spheres are where they are in another result, to the last bit.
template <int D>
bool same_bits(const Settled<D>& a, const Settled<D>& b) {
  return a.centres == b.centres && a.steps == b.steps;
}

} // namespace tamp::test
