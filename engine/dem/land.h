// Spheres that are still in the air when a bed has its shape, set down on it.
#pragma once

#include "engine/dem/state.h"
#include "engine/search/contact_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp {

/// Whether nothing but its weight acts on a sphere.
template <int D, class Law>
bool floats(const State<D, Law>& s, std::size_t i) {
  return s.force[i] == Vec<D>(-s.weight[i] * Vec<D>::Unit(vertical<D>));
}

/// Moves every sphere that touches nothing straight down to what it meets first, low ones before high ones, and takes
/// its motion: the last few of a fall would bounce for as long as all the others took to settle.
template <int D, class Law>
void land_floating(State<D, Law>& s, const SearchBox<D>& box) {
  constexpr int z = vertical<D>;
  std::vector<std::size_t> in_air;
  for (std::size_t i = 0; i < s.count(); ++i) {
    if (floats(s, i))
      in_air.push_back(i);
  }
  std::stable_sort(in_air.begin(), in_air.end(),
                   [&](std::size_t a, std::size_t b) { return s.centre[a][z] < s.centre[b][z]; });
  for (const std::size_t i : in_air) {
    double lowest = std::min(s.centre[i][z], s.radius[i]); // on the floor
    for (std::size_t j = 0; j < s.count(); ++j) {
      Vec<D> aside = s.centre[j] - s.centre[i];
      if (j == i || aside[z] >= 0)
        continue;
      const double above = aside[z];
      aside[z] = 0;
      for (int a = 0; a < z; ++a) {
        if (box.periodic[static_cast<std::size_t>(a)])
          aside[a] -= box.size[a] * std::round(aside[a] / box.size[a]);
      }
      const double touching = s.radius[i] + s.radius[j];
      if (const double left = touching * touching - aside.squaredNorm(); left > 0)
        lowest = std::max(lowest, std::min(s.centre[i][z], s.centre[i][z] + above + std::sqrt(left)));
    }
    s.centre[i][z] = lowest;
    s.velocity[i].setZero();
    if constexpr (Law::turns)
      s.spin[i] = zero_spin<D>();
  }
}

} // namespace tamp
