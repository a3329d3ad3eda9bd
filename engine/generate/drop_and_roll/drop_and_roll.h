// Drop-and-roll: spheres fall one by one and roll into the nearest hollow (Hitti & Bernacki 2013).
#pragma once

#include "engine/generate/generator.h"

namespace tamp {

/// The generator of MethodName::drop_and_roll, in 2D and 3D. Each attempt draws a uniform position of the plan and
/// drops the sphere from above the bed; a sphere that comes to rest above the lid is a failure. It ends after
/// max_failures failures in a row, or when the scene's count is reached. did_not_converge: the box was full before the
/// count was.
Generated generate_drop_and_roll(const Request& request);

} // namespace tamp
