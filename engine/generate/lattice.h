// Equal spheres on a lattice: packings whose density is known, to judge the metrics by.
#pragma once

#include "engine/generate/generator.h"

#include <string_view>

namespace tamp {

/// Fills the scene's walled box with touching spheres of its one size on the method's lattice, every sphere wholly
/// inside (up to rounding), the first against the lower corner, layers level. scene.count limits their number, lowest
/// cells first. Not applicable, with the reason: a lattice of the other dimension, a law of several sizes, periodic
/// sides, fewer places than scene.count. Uses no random numbers.
Generated generate_lattice(const Request& request);

} // namespace tamp
