// The generator lammps-isostatic: a periodic box of frictionless spheres compressed by the program LAMMPS until it
// jams.
#pragma once

#include "engine/generate/generator.h"

namespace tamp {

/// Spheres of the scene's law from a loose cloud without contacts (or the parent's from where they are) in a box with
/// every axis periodic, compressed by a constant pressure on all axes (`fix press/berendsen`) until volume, motion and
/// contacts rest; then again under less pressure, until the tolerated overlap is met. Contacts are Hertz's, of modulus
/// 1: as there is no weight, only the ratio of pressure to modulus counts.
///
/// Not applicable, with the reason: no LAMMPS, or one without the styles needed; a box that its largest sphere does not
/// leave room in.
Generated generate_lammps_isostatic(const Request& request);

} // namespace tamp
