// The table of generators.
#include "engine/generate/generator.h"

#include "engine/base/error.h"
#include "engine/generate/dem_gravity.h"
#include "engine/generate/dem_isostatic.h"
#include "engine/generate/drop_and_roll/drop_and_roll.h"
#include "engine/generate/lammps/lammps_gravity.h"
#include "engine/generate/lammps/lammps_isostatic.h"
#include "engine/generate/lattice.h"
#include "engine/generate/moving_enlarging/moving_enlarging.h"

#include <fmt/format.h>

#include <array>

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
  return kGenerators[static_cast<std::size_t>(method)].generate(request);
}

} // namespace tamp
