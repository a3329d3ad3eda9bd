// The table of a campaign's powders: parameters, moments and quantiles of each size law, and how dense it can lie.
#pragma once

#include "report/runs.h"
#include "report/table.h"

#include <span>

namespace tamp {

/// One row for each size law of the jobs, in their order; lengths in µm. Made from the campaign alone: no job need have
/// run.
Table powders_table(std::span<const Run> runs);

} // namespace tamp
