// The generator dem-gravity: settles a loose cloud, or another packing, under gravity by the discrete element method.
#pragma once

#include "engine/generate/generator.h"

namespace tamp {

/// Spheres of the scene's law fall from a loose cloud between the scene's sides onto its floor (or the parent's spheres
/// from where they are, in the parent's box) and settle until net forces and, where motion is followed in time, kinetic
/// energy are below the method's limits. There is no lid: the bed ends where it ends. `count` 0 takes as many spheres
/// as about fill the box.
///
/// Only effects that the material calls for are simulated: friction (with rotation) if mu > 0, adhesion if W > 0, by
/// JKR or DMT; with neither, elastic and gravitational energy is minimised and there is no time.
///
/// Contacts are softer than the material's: as soft as the tolerated overlap allows, so that steps can be long. What
/// overlap is left is in the measures. Not applicable, with the reason: a sphere wider than the box.
Generated generate_dem_gravity(const Request& request);

} // namespace tamp
