// Packing fraction at which spheres of a size law jam at random, estimated before any is placed.
#pragma once

#include "engine/model/size_law.h"

namespace tamp {

/// Farr & Groot, J. Chem. Phys. 131, 244104 (2009): spheres are cut by a random line into rods, which are packed in one
/// dimension with f = 0.7654. In 2D, where that has no counterpart: the value for discs of two sizes, 0.84.
double random_close_packing(const SizeLaw& law, int dimension);

} // namespace tamp
