// A loose cloud of spheres that do not touch, for methods that let them fall or squeeze them together.
#pragma once

#include "engine/base/random.h"
#include "engine/base/vec.h"

#include <array>
#include <vector>

namespace tamp {

/// Spheres above the floor of a box open at the top.
template <int D>
struct Cloud {
  std::vector<Vec<D>> centres;
  std::vector<double> radii;
};

/// Places spheres of these radii at random without contact, large ones first, in a column above the box's floor just
/// high enough for the packing fraction phi (in (0, 0.3]); where a sphere finds no place the column grows. `size`:
/// edges of the box, of which the vertical one is of no account; lateral axes are periodic or walls. Every sphere must
/// fit between the walls. Spheres come ordered by columns and height, so that near ones are near in memory, too.
template <int D>
Cloud<D> loose_cloud(const Vec<D>& size, const std::array<bool, D>& periodic, std::vector<double> radii, double phi,
                     RandomStream random);

/// A cloud in a periodic box, and the box.
template <int D>
struct PeriodicCloud {
  Vec<D> size;
  Cloud<D> cloud;
};

/// The same in a box of the shape of `shape` with periodic sides all around, at the packing fraction phi or, where
/// spheres find no place, below it. No sphere reaches through the floor.
template <int D>
PeriodicCloud<D> loose_periodic_cloud(const Vec<D>& shape, const std::vector<double>& radii, double phi,
                                      const RandomStream& random);

extern template PeriodicCloud<2> loose_periodic_cloud<2>(const Vec<2>&, const std::vector<double>&, double,
                                                         const RandomStream&);
extern template PeriodicCloud<3> loose_periodic_cloud<3>(const Vec<3>&, const std::vector<double>&, double,
                                                         const RandomStream&);
extern template Cloud<2> loose_cloud<2>(const Vec<2>&, const std::array<bool, 2>&, std::vector<double>, double,
                                        RandomStream);
extern template Cloud<3> loose_cloud<3>(const Vec<3>&, const std::array<bool, 3>&, std::vector<double>, double,
                                        RandomStream);

} // namespace tamp
