// The table of generators.
#include "engine/generate/generator.h"

#include "engine/base/error.h"
#include "engine/generate/dem_gravity.h"
#include "engine/generate/dem_isostatic.h"
#include "engine/generate/drop_and_roll/drop_and_roll.h"
#include "engine/generate/effects_ledger.h"
#include "engine/generate/lammps/lammps_gravity.h"
#include "engine/generate/lammps/lammps_isostatic.h"
#include "engine/generate/lattice.h"
#include "engine/generate/moving_enlarging/moving_enlarging.h"

#include <fmt/format.h>

#include <array>
#include <numeric>

namespace tamp {

namespace {

constexpr std::array kGenerators = {
    Generator{MethodName::drop_and_roll, &generate_drop_and_roll},
    Generator{MethodName::lattice, &generate_lattice},
    Generator{MethodName::drop_and_roll_me, &generate_moving_enlarging},
    Generator{MethodName::dem_gravity, &generate_dem_gravity},
    Generator{MethodName::dem_isostatic, &generate_dem_isostatic},
    Generator{MethodName::lammps_gravity, &generate_lammps_gravity},
    Generator{MethodName::lammps_isostatic, &generate_lammps_isostatic},
};

/// In metres.
double mean_radius(const Packing& packing) {
  return std::accumulate(packing.radii.begin(), packing.radii.end(), 0.0) / static_cast<double>(packing.count()) *
         metres(packing.unit);
}

} // namespace

std::span<const Generator> generators() {
  return kGenerators;
}

Generated generate(const Request& request) {
  const MethodName method = request.job.method.name;
  const Start start = info(method).start;
  if ((start == Start::scene && request.parent != nullptr) || (start == Start::packing && request.parent == nullptr))
    throw InputError(
        fmt::format("{} {}", name_of(method),
                    start == Start::scene ? "cannot start from a packing" : "needs a packing to start from"));
  Generated out = kGenerators[static_cast<std::size_t>(method)].generate(request);
  if (out.packing.count() > 0) {
    const Effects ledger = effects_ledger(request.job.scene, request.job.method, mean_radius(out.packing));
    out.effects.simulated.insert(out.effects.simulated.begin(), ledger.simulated.begin(), ledger.simulated.end());
    out.effects.left_out.insert(out.effects.left_out.begin(), ledger.left_out.begin(), ledger.left_out.end());
  }
  return out;
}

} // namespace tamp
