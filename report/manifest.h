// Which files of a folder a report wrote, so that the next one there leaves none of its files behind.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tamp {

/// Name of the list in the folder of a report: a file name a line.
inline constexpr const char* kManifestFile = "written-by-tamp.txt";

/// The list of the files that reports wrote into a folder. Nothing that is not on it is ever touched.
class Manifest {
public:
  /// Reads the folder's list, if it has one. Names that lead out of the folder are left out.
  explicit Manifest(std::filesystem::path folder);

  /// Adds these names to the list, before any of the files is written: a report that breaks off leaves no stray files.
  void announce(std::span<const std::string> names) const;

  /// Removes the files that are on the list and not among these, and makes these the list.
  void keep_only(std::span<const std::string> names) const;

private:
  std::filesystem::path folder_;
  std::vector<std::string> earlier_;
};

} // namespace tamp
