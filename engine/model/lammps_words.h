// Words that both the writers and the readers of LAMMPS's formats use.
#pragma once

#include "engine/model/scene.h"

#include <optional>
#include <string_view>
#include <utility>

namespace tamp {

/// In the first line of our data files: the statements after it are ours to trust.
inline constexpr std::string_view kByTamp = "by tamp";

/// LAMMPS's systems of units by their unit of length; it has none in millimetres.
inline constexpr std::array<std::pair<LengthUnit, std::string_view>, 4> kLammpsUnits{
    {{LengthUnit::nm, "nano"}, {LengthUnit::um, "micro"}, {LengthUnit::m, "si"}, {LengthUnit::mm, "mm"}}};

constexpr std::string_view lammps_units(LengthUnit unit) {
  for (const auto& [ours, name] : kLammpsUnits) {
    if (ours == unit)
      return name;
  }
  return "lj";
}

/// Nothing for systems in other lengths (lj, real, metal, cgs …).
constexpr std::optional<LengthUnit> unit_of_lammps(std::string_view name) {
  for (const auto& [ours, known] : kLammpsUnits) {
    if (known == name)
      return ours;
  }
  return std::nullopt;
}

} // namespace tamp
