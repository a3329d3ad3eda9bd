// The SHA-256 of a file, without reading it into memory as a whole.
#pragma once

#include <filesystem>
#include <string>

namespace tamp {

/// 64 lower-case hexadecimal digits; throws Error if the file cannot be read. The file must not shrink meanwhile.
std::string file_sha256(const std::filesystem::path& path);

} // namespace tamp
