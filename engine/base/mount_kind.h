// Tells file systems of the network from local ones: memory shared between machines cannot be mapped on them.
#pragma once

#include <filesystem>
#include <string_view>

namespace tamp {

/// The name of a network file system ("NFS") by its number in statfs(2), f_type; empty for every other.
std::string_view network_file_system(long type);

/// The same of the file system that holds a path; empty also if that cannot be told.
std::string_view network_file_system(const std::filesystem::path& path);

} // namespace tamp
