// Isostatic compression: frictionless spheres in a periodic box that shrinks until they jam or have the packing
// fraction that is asked for.
#pragma once

#include "engine/generate/generator.h"

namespace tamp {

/// All axes are periodic, the vertical one, too, whatever the scene's sides: there is no gravity and no floor.
///
/// From the scene: scene.count spheres at random places in a box of the scene's shape. It ends as large as they need,
/// so its size is a result. With count 0 the number is chosen for the final box to be the scene's: exactly up to one
/// sphere with a target_phi, otherwise as well as random_close_packing() tells the jammed density. From a packing: its
/// spheres and box, made periodic.
///
/// Measures: phi_box (volume of all spheres over that of the box), residual_overlap, hard_cost_phi (what `hard` cost),
/// pressure, force_balance, evaluations, list_rebuilds, list_repairs. Did not converge: jammed below the target, or not
/// within the evaluations allowed. Not applicable: a largest sphere that fills the box.
Generated generate_dem_isostatic(const Request& request);

} // namespace tamp
