// The command line of `tamp job`, as a run and an element of a job array start it.
#pragma once

#include "engine/model/plan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tamp::cli {

/// This very program as the child that runs a job file and leaves its result in `out`; `parent`: the packing that the
/// job starts from, empty if it starts from its scene.
std::vector<std::string> child_line(const std::filesystem::path& job, const std::filesystem::path& out,
                                    const std::filesystem::path& parent, const RunSettings& run);

} // namespace tamp::cli
