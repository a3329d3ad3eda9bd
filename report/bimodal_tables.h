// Tables of binary mixtures: one over the size ratio beside the paper's, and one of the Furnas plane.
#pragma once

#include "report/runs.h"
#include "report/table.h"

#include <span>
#include <vector>

namespace tamp {

/// The groups with a bimodal law in 3D, by increasing size ratio, of each in the order of the campaign.
std::vector<RunGroup> bimodal_groups(std::span<const Run> runs);

/// Panel (a) has the paper's columns with lines "this run", "paper", "difference"; panel (b) what the paper does not
/// print. A group in which no run ended ok shows how its runs ended in the place of N. The first notes are filled in.
Table bimodal_table(std::span<const RunGroup> groups);

/// Packing fraction, and the composition reached, over X_L (down) and the size ratio (across), one pair of panels for
/// each method label. The first notes are filled in.
Table furnas_table(std::span<const RunGroup> groups);

} // namespace tamp
