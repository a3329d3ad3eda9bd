// The table of effects: what each method simulated of a scene, and what leaving the rest out saved.
#pragma once

#include "report/runs.h"
#include "report/table.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tamp {

/// Groups that differ in `simulate` alone; nullptr where the campaign has no such runs.
struct EffectsFamily {
  std::string label;
  std::vector<RunGroup> groups;

  [[nodiscard]] const RunGroup* of(Simulate simulate) const;
};

/// Families of at least two groups, in the order of the campaign.
std::vector<EffectsFamily> effects_families(std::span<const Run> runs);

/// Panels: which effects ran, by method; time and packing fraction by the scene's own kernel, with motion in time, and
/// with every effect.
Table effects_table(std::span<const Run> runs);

} // namespace tamp
