// Whether a sphere rests on its supports: is its centre above the hull of the points it stands on?
#pragma once

#include "engine/base/vec.h"

#include <span>

namespace tamp {

/// points: horizontal places of the supports seen from the sphere's centre, in units of its radius, in D − 1
/// dimensions. True if the origin is in their hull or within `tolerance` of it. Inside is decided by exact predicates;
/// the tolerance lets a sphere balance on supports that face each other exactly up to rounding.
template <int D>
bool rests_on(std::span<const Vec<D - 1>> points, double tolerance);

} // namespace tamp
