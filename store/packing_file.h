// Packings on disk: HDF5 with the group names of H5MD 1.1; the same packing always gives the same bytes.
#pragma once

#include "engine/model/packing.h"

#include <filesystem>
#include <string>

namespace tamp {

/// What a packing file says about its origin. Nothing that differs from run to run (time, host, user) belongs here.
struct PackingLabel {
  std::string key;             ///< of the job that made it; empty for a foreign packing
  std::string canonical;       ///< canonical JSON of that job
  std::string method;          ///< name of the method
  std::string creator_version; ///< of tamp
};

/// Writes the packing under `path`, whole or not at all. Throws Error naming the file. Any thread may call (HDF5 calls
/// take turns). Layout:
///   /h5md                        version = 1.1; groups author, creator (name, version), modules/units
///   /particles/powder/box        attributes dimension, boundary ("none" | "periodic"); dataset edges [D]
///   /particles/powder/position   [N][D], fixed in time
///   /particles/powder/radius     [N], fixed in time
///   /parameters/tamp             attributes format, key, method, boundary ("wall" | "periodic" | "open"); dataset
///                                canonical (one string)
/// Every dataset of lengths has the attribute `unit`. Numbers are little-endian IEEE doubles, stored contiguously.
void write_packing(const std::filesystem::path& path, const Packing& packing, const PackingLabel& label);

/// Reads what write_packing wrote. Throws Error naming the file and what is wrong with it (missing, truncated, not
/// HDF5, not a packing, contradictory shapes).
Packing read_packing(const std::filesystem::path& path);

/// The origin of a packing file; errors as in read_packing.
PackingLabel read_packing_label(const std::filesystem::path& path);

} // namespace tamp
