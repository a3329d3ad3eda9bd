// The table of what accuracy costs: error and time over each knob, orders of convergence, the front, cheapest settings.
#pragma once

#include "report/knob_families.h"
#include "report/table.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tamp {

/// One setting of one method: what it costs and how exact it is.
struct Setting {
  const KnobFamily* family = nullptr;
  std::size_t level = 0;
  double seconds = 0; ///< median time of the whole way from the scene
  double error = 0;   ///< bound of the relative error of the packing fraction (95 %)

  /// Another one that is as exact in a time that is clearly shorter, or clearly more exact in the same time.
  [[nodiscard]] bool beaten_by(const Setting& other) const;
};

/// Every timed level of the families whose error of phi is known.
std::vector<Setting> settings_of(std::span<const KnobFamily> families);

/// Those that no other beats, by increasing time.
std::vector<Setting> front_of(std::span<const Setting> settings);

/// The fastest setting with an error of at most that share; nullptr if none is known to be so exact.
const Setting* cheapest(std::span<const Setting> settings, double share);

/// Panels: every level of every knob; every knob with its order, its default's place and the cheapest settings.
Table accuracy_table(std::span<const KnobFamily> families);

} // namespace tamp
