// Campaign files: from JSON on disk to a Plan, or to one error that shows every mistake in its place.
#pragma once

#include "engine/model/plan.h"

#include <filesystem>
#include <string_view>

namespace tamp {

/// Reads, validates and expands a campaign file (format: campaigns/README.md). Jobs come in the order of the file:
/// points of the sweep, then methods, then replicates; of jobs with the same key only the first stays. Throws
/// InputError with one paragraph a mistake, each with file, line, column, JSON pointer, value, what is allowed and the
/// nearest known word.
Plan load_campaign(const std::filesystem::path& file);

/// The same for text already in memory; `file` is the name in messages, and paths in the text are relative to its
/// folder.
Plan read_campaign(std::string_view text, const std::filesystem::path& file);

} // namespace tamp
