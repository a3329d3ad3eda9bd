// From the statements of a campaign file to jobs: sweeps multiplied out, every point checked as a whole.
#pragma once

#include "campaigns/campaign_file.h"

#include <vector>

namespace tamp {

/// A campaign that would expand into more jobs than this is taken for a slip.
inline constexpr std::size_t kMostJobs = 100'000;

/// The jobs of the file: points in the order of the file, at each the methods, of each the replicates. A swept method
/// parameter counts only for methods that have it; jobs that come out equal stay once. Adds a mistake for each
/// impossible combination of values (at the sweep's value if the sweep makes it wrong, with the point), for required
/// values that are missing, and for values that count nowhere; then, or if there were mistakes before, there are no
/// jobs.
std::vector<PlannedJob> expand(const CampaignFile& file, Mistakes& mistakes);

} // namespace tamp
