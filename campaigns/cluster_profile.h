// Reads the profile file of a cluster: one JSON object, every key optional.
#pragma once

#include "engine/model/cluster_profile.h"

#include <filesystem>
#include <string_view>

namespace tamp {

/// The profile of a text; `file` is its name in messages. Throws InputError with every mistake in it.
ClusterProfile read_cluster_profile(std::string_view text, const std::filesystem::path& file);

/// The same of a file. Throws InputError also if there is none.
ClusterProfile load_cluster_profile(const std::filesystem::path& file);

} // namespace tamp
