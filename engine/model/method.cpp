// The table of methods and their revisions.
#include "engine/model/method.h"

#include <array>

namespace tamp {

namespace {

constexpr std::array kMethods = {
    MethodInfo{MethodName::drop_and_roll, 4, Start::scene,
               "drop each sphere, roll it down to a stable place (sequential, geometric)"},
    MethodInfo{MethodName::lattice, 1, Start::scene,
               "equal spheres on a lattice of known density, to judge the metrics"},
    MethodInfo{MethodName::drop_and_roll_me, 1, Start::packing,
               "move the spheres of a drop-and-roll packing into the middle of their neighbours and let them grow"},
    MethodInfo{MethodName::dem_gravity, 4, Start::either,
               "settle a loose cloud, or another packing, under gravity (discrete element method)"},
    MethodInfo{MethodName::dem_isostatic, 5, Start::either,
               "compress spheres in a periodic box until they jam, or to a prescribed packing fraction"},
    MethodInfo{MethodName::lammps_gravity, 4, Start::either,
               "the same as dem-gravity, done by the program LAMMPS, which must be installed"},
    MethodInfo{MethodName::lammps_isostatic, 4, Start::either,
               "compress frictionless spheres in a periodic box until they jam, by the program LAMMPS"},
};

} // namespace

std::span<const MethodInfo> methods() {
  return kMethods;
}

const MethodInfo& info(MethodName name) {
  return kMethods[static_cast<std::size_t>(name)];
}

} // namespace tamp
