// The table of generators.
#include "engine/generate/generator.h"

#include "engine/generate/drop_and_roll/drop_and_roll.h"
#include "engine/generate/lattice.h"

#include <array>

namespace tamp {

namespace {

constexpr std::array kGenerators = {
    Generator{MethodName::drop_and_roll, &generate_drop_and_roll},
    Generator{MethodName::lattice, &generate_lattice},
};

} // namespace

std::span<const Generator> generators() {
  return kGenerators;
}

Generated generate(const Job& job, std::string_view key, const Progress& progress) {
  return kGenerators[static_cast<std::size_t>(job.method.name)].generate(job, key, progress);
}

} // namespace tamp
