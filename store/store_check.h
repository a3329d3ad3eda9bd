// Looks a whole store over: which packings are what their records say; moves aside what is not.
#pragma once

#include "store/store.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tamp {

struct StoreFindings {
  std::size_t intact = 0;                        ///< packings with the SHA-256 of their records
  std::vector<std::string> missing;              ///< keys whose record names a packing that is not there
  std::vector<std::filesystem::path> damaged;    ///< packings with another SHA-256, or that cannot be read
  std::vector<std::filesystem::path> unrecorded; ///< files among the packings that no record names

  [[nodiscard]] bool sound() const { return missing.empty() && damaged.empty() && unrecorded.empty(); }
};

/// Checks every packing; changes nothing. Throws Error if the database cannot be read.
StoreFindings check_store(const Store& store);

/// Makes a new database of the attempts that can still be read from a damaged one, and moves the damaged one into the
/// quarantine; returns how many attempts that are. Which jobs a campaign names is written anew by its next run. By the
/// holder of jobs.lock, while no Store of this folder is open. Throws Error.
std::size_t salvage_database(const std::filesystem::path& store);

/// Where damaged files of the store in this folder are put: STORE/quarantine.
std::filesystem::path quarantine_folder(const std::filesystem::path& store);

/// Moves damaged and unrecorded files into the quarantine, under names that are free there, so that the next run makes
/// their packings again. By the holder of jobs.lock. Throws Error.
void quarantine(const Store& store, const StoreFindings& findings);

} // namespace tamp
