// From soft particles, which overlap a little, to hard ones.
#pragma once

#include "engine/model/packing.h"

namespace tamp {

/// Widens a packing, its box and the places of its particles, by the one factor at which nothing overlaps, neither
/// particles nor walls; radii stay. Returns the factor, 1 if nothing overlaps. The same as shrinking all particles
/// alike, which keeps the shape of their size distribution.
double harden(Packing& packing);

/// Largest overlap relative to the smaller radius, of particles and with walls; 0 if nothing overlaps.
double deepest_overlap(const Packing& packing);

} // namespace tamp
