// Groups that differ in one accuracy knob alone, and how far each of its levels is from the finest or from the limit.
#pragma once

#include "engine/model/accuracy_knobs.h"
#include "report/convergence_order.h"
#include "report/runs.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tamp {

/// Fewer levels than this show no trend.
inline constexpr std::size_t kFewestLevels = 3;

/// What is known of the mean of a quantity: about 0 if it is a difference.
struct Estimate {
  double value = ConvergenceOrder::kNone;
  double half_width = ConvergenceOrder::kNone; ///< of the 95 % interval

  /// The least number that the absolute value does not exceed at that confidence.
  [[nodiscard]] double bound() const;
};

struct KnobLevel {
  RunGroup group;
  double value = 0;        ///< of the knob
  bool is_default = false; ///< the value that a method takes where none is stated
};

/// What a knob does to one quantity, in the units of that quantity. `paired`: every level has the same replicates, from
/// the same packings, and what these have in common is taken out.
struct KnobEffect {
  std::string quantity;
  std::vector<Estimate> error; ///< of each level, from `reference`
  ConvergenceOrder order;
  double reference = ConvergenceOrder::kNone; ///< the limit if there is an order, else the mean of the finest level
  bool paired = false;
};

/// One method label, one knob, levels from coarse to fine.
struct KnobFamily {
  std::string label;
  const AccuracyKnob* knob = nullptr;
  std::vector<KnobLevel> levels;
};

/// Every family of at least kFewestLevels levels, in the order of the campaign and of kAccuracyKnobs. One group may be
/// a level of several.
std::vector<KnobFamily> knob_families(std::span<const Run> runs);

/// The effect on "phi" (density_of() of report/quantities.h) or on any other measure; nothing if fewer than
/// kFewestLevels levels have it twice. Levels without it have NaN.
std::optional<KnobEffect> knob_effect(const KnobFamily& family, const std::string& quantity);

} // namespace tamp
