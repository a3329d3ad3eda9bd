// The effects ledger: what a method simulates of a scene, what it leaves out, and by which rule; known before anything
// runs.
#pragma once

#include "engine/model/job.h"
#include "engine/model/record.h"

namespace tamp {

/// `radius`: mean one of the particles in metres, above 0; of it are the numbers by which the rules decide: Tabor's
/// parameter, pull-off force over weight, weight of the bed over stiffness. The scene must be completed.
Effects effects_ledger(const Scene& scene, const Method& method, double radius);

/// The same with the mean radius of the scene's law, for a job that has not run.
Effects effects_ledger(const Job& job);

} // namespace tamp
