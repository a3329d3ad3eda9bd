// The table of one powder in boxes of many sizes: convergence, representative volume, and the scaling of the time.
#pragma once

#include "report/plateau.h"
#include "report/power_law.h"
#include "report/runs.h"
#include "report/table.h"

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace tamp {

/// What counts as converged: of packing fractions, and of Hellinger distances.
inline constexpr PlateauCriterion kPhiCriterion{0.01, 0.01};
inline constexpr PlateauCriterion kHellingerCriterion{0.02, 0.02};

/// Groups that differ in nothing but the box, the count and the radii at which the law is cut, by increasing box and
/// count.
struct SizeFamily {
  std::string name; ///< label of the method, with the law where one label has several
  std::vector<RunGroup> groups;
};
std::vector<SizeFamily> size_families(std::span<const Run> runs);

/// The points of a family's power law: for each group the geometric means of N and of the time over its ok runs of one
/// timing mode. That mode is exclusive if any run of the family has it: the two are never mixed.
struct TimedPoints {
  TimingMode mode = TimingMode::shared;
  std::vector<PowerPoint> points;
  std::vector<std::optional<std::size_t>> of_group; ///< the point of each group of the family
  std::size_t left_out = 0;                         ///< ok runs of the other mode
  std::size_t disturbed = 0;                        ///< ok runs of this mode whose times do not count
  std::set<std::string> processors;                 ///< on which the times were taken
};
TimedPoints timed_points(const SizeFamily& family);

/// Edge of the cube (2D: square) that holds as much as the group's box, in µm.
double edge_of(const RunGroup& group);

/// Panels: by size; distances of the radii to the law; scaling of the time; convergence, for families filled without a
/// count. The first notes are filled in.
Table domain_size_table(std::span<const SizeFamily> families);

} // namespace tamp
