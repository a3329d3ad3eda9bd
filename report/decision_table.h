// Which method for which need: for each powder and box, the best of the methods that were run, judged by the records.
#pragma once

#include "report/runs.h"
#include "report/table.h"

#include <span>

namespace tamp {

/// One panel for each scene in which two or more groups have ok runs, in the order of the campaign. Lines are needs:
/// fastest (least time per sphere), densest (largest mean phi), most faithful (least excess of H_N and of H_V, in 2D
/// H_S, over their sampling floors, of which the larger counts); with `phi_exp`, the packing fraction of an experiment,
/// also closest (least |phi − phi_exp|) and closest per cost (that times the time per sphere). Each shows the winner's
/// number, the next one's, and whether their means differ by the test of comparison.h. What cannot be judged is named
/// in a note: methods without a packing, mixtures far from the scene's. Empty where no scene has two methods.
Table decision_table(std::span<const Run> runs, double phi_exp = unstated);

/// Means are told apart where such a difference has less than this chance among equal ones.
inline constexpr double kTellApart = 0.05;

} // namespace tamp
