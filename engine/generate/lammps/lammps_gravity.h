// The generator lammps-gravity: the scene of dem-gravity, settled by the program LAMMPS.
#pragma once

#include "engine/generate/generator.h"

namespace tamp {

/// What dem-gravity settles (for the same key the same spheres from the same places) under the same laws of contact,
/// always followed in time; see SettlingScene. LAMMPS runs in stages: contacts start soft, and after each stage that
/// came to rest they are stiffened until the tolerated overlap is met. A step that proves too long is halved.
///
/// Rest: kinetic energy, mean height and contacts. Scripts, logs and, where the job is cut off, the state reached stay
/// in request.folder. Not applicable, with the reason: no LAMMPS, or one without the styles needed; a sphere wider than
/// the box.
Generated generate_lammps_gravity(const Request& request);

} // namespace tamp
