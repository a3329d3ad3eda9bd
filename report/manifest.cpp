// Reads and writes the list.
#include "report/manifest.h"

#include "engine/base/files.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace tamp {

namespace {

namespace fs = std::filesystem;

void write_list(const fs::path& file, const std::set<std::string>& names) {
  std::string lines;
  for (const std::string& name : names)
    lines += name + "\n";
  write_atomically(file, lines);
}

/// Whether it names an entry of the folder itself.
bool is_plain(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && path.filename() == path && name != "." && name != "..";
}

} // namespace

Manifest::Manifest(fs::path folder) : folder_(std::move(folder)) {
  const fs::path file = folder_ / kManifestFile;
  if (!fs::exists(file))
    return;
  std::istringstream lines(read_file(file));
  for (std::string name; std::getline(lines, name);) {
    if (is_plain(name))
      earlier_.push_back(name);
  }
}

void Manifest::announce(std::span<const std::string> names) const {
  std::set<std::string> all(names.begin(), names.end());
  all.insert(earlier_.begin(), earlier_.end());
  write_list(folder_ / kManifestFile, all);
}

void Manifest::keep_only(std::span<const std::string> names) const {
  const std::set<std::string> now(names.begin(), names.end());
  for (const std::string& name : earlier_) {
    std::error_code gone; // a file that cannot be removed is no harm
    if (!now.contains(name))
      fs::remove(folder_ / name, gone);
  }
  write_list(folder_ / kManifestFile, now);
}

} // namespace tamp
