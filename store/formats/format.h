// The table of the formats in which packings come and go.
#pragma once

#include "engine/model/packing_builder.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// A number for each sphere that was measured on the packing, for formats that carry such columns.
struct SphereField {
  std::string name;
  std::vector<double> values; ///< one a sphere
};

/// What a writer may need beyond the packing; each reads only its own.
struct ExportOptions {
  std::vector<SphereField> fields;   ///< vtp
  std::int64_t voxels = 200;         ///< meta-image: along the longest edge of the box
  std::int64_t subdivisions = 2;     ///< stl: of an icosahedron's 20 triangles, each time into four
  std::string creator_version = "0"; ///< h5
};

/// A row. Lengths are written in the packing's unit with all their digits, so what is read back is equal to what was
/// written, except where `summary` says what is lost.
struct Format {
  std::string_view name;
  std::string_view endings; ///< of file names, separated by blanks, the first preferred
  std::string_view summary;
  /// Throws Error if the file cannot be written, InputError for a packing the format cannot hold. Null: not written.
  void (*write)(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
  /// Throws InputError, with the line where there are lines, for anything but a sound packing. Null: not read.
  ReadPacking (*read)(const std::filesystem::path& path, const Surroundings& stated);
};

std::span<const Format> formats();

/// The format of a name, of a file to be written (by its ending), or of one to be read (by its first bytes where these
/// tell, else by its ending). Throw InputError with what is allowed.
const Format& format_named(std::string_view name);
const Format& format_of_ending(const std::filesystem::path& path);
const Format& format_of_file(const std::filesystem::path& path);

/// Reads a packing in whatever format the file has.
ReadPacking read_foreign(const std::filesystem::path& path, const Surroundings& stated = {});

} // namespace tamp
