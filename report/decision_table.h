// Which method for which need: for each powder and box, the best of the methods that were run, judged by the records.
#pragma once

#include "report/runs.h"
#include "report/table.h"

#include <span>

namespace tamp {

/// One panel for each scene in which two or more groups have ok runs, in the order of the campaign. Lines are needs:
/// fastest (least time per sphere), densest (largest mean phi), most faithful (least H_V, in 2D H_S, in units of its
/// sampling floor). Each shows the winner's number, the next one's, and whether their means differ by more than
/// kTellApart standard errors. Empty where no scene has two methods.
Table decision_table(std::span<const Run> runs);

/// Means closer than so many standard errors of their difference are not told apart.
inline constexpr double kTellApart = 2;

} // namespace tamp
