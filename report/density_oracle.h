// The density at which a scene's powder is expected to jam, and how far a group's packings are from it.
#pragma once

#include "report/runs.h"
#include "report/table.h"

#include <array>
#include <map>
#include <span>
#include <string>

namespace tamp {

/// Random close packing of a scene's powder (engine/model/random_close_packing.h); remembers it, as it takes
/// milliseconds and a campaign has few powders.
class DensityOracle {
public:
  double operator()(const Scene& scene);

private:
  std::map<std::string, double> known_;
};

/// Headings of oracle_cells().
std::array<Column, 2> oracle_columns();

/// The expected density of a 3D powder, and the mean exact packing fraction minus it ± standard deviation, doubtful
/// where that is above 0 by more than the standard deviation. Empty in 2D, where no theory is known.
std::array<Cell, 2> oracle_cells(const RunGroup& group, DensityOracle& oracle);

/// Groups whose density is above the expected one by more than their standard deviation (of a single packing, its
/// standard error), each with the descriptor that shows why: overlaps, another mixture, crystals; empty if there is
/// none.
std::string above_in_words(std::span<const RunGroup> groups);

/// What the two columns mean.
std::string oracle_sentence();

} // namespace tamp
