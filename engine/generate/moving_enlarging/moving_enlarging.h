// Moving-enlarging: spheres of a drop-and-roll bed move into the middle of their neighbours and grow there.
#pragma once

#include "engine/generate/generator.h"

namespace tamp {

/// The generator of MethodName::drop_and_roll_me, after the D&R-ME of the paper: each sweep moves every sphere towards
/// the barycentre of its neighbours in the power diagram, by the step among 1, 1/2, 1/4, … of the way that leaves it
/// the most room, and lets it grow into that room, never beyond the largest radius of the law. Every step is checked
/// against all that the sphere could touch, whether the triangulation lists it or not. Needs a parent.
/// not_applicable: laws of exact sizes (monodisperse, bimodal), which growing would destroy.
Generated generate_moving_enlarging(const Request& request);

} // namespace tamp
