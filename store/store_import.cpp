// Taking in results of child processes, in an order that leaves the store consistent wherever it is cut off.
#include "engine/base/file_system.h"
#include "engine/base/files.h"
#include "engine/base/sha256.h"
#include "store/file_digest.h"
#include "store/packing_file.h"
#include "store/record_json.h"
#include "store/record_rows.h"
#include "store/store_parts.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

namespace tamp {
namespace {

namespace fs = std::filesystem;

/// The result itself is at fault, not the disk: trying again would not help.
struct DamagedResult : Error {
  using Error::Error;
};

/// What std::filesystem throws, as an Error.
template <class F>
auto with_disk_errors(F&& f) {
  try {
    return f();
  } catch (const fs::filesystem_error& e) {
    throw Error(e.what());
  }
}

/// The files of a folder with this extension, by name.
std::vector<fs::path> files_in(const fs::path& folder, std::string_view extension) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension)
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The record of a JSON file, if it can be recorded at all.
Record checked_record(const fs::path& json) {
  const std::string text = read_file(json);
  try {
    Record record = record_from_json(text, json.string());
    check_storable(record);
    if (sha256_hex(record.canonical) != record.key)
      throw Error(fmt::format("{}: the key is not the SHA-256 of the canonical text", json.string()));
    return record;
  } catch (const Error& e) {
    throw DamagedResult(e.what());
  }
}

void check_digest(const fs::path& packing, const Record& record) {
  if (!fs::exists(packing))
    throw DamagedResult(fmt::format("{} is missing, though its record is there", packing.string()));
  if (file_sha256(packing) != record.packing_sha256) {
    throw DamagedResult(
        fmt::format("{} is damaged or not what record {} describes: the SHA-256 differ", packing.string(), record.key));
  }
}

void check_reproduced(const Record& record, const std::optional<Record>& known) {
  if (known && known->outcome == Outcome::ok && known->packing_sha256 != record.packing_sha256) {
    throw DamagedResult(
        fmt::format("the packing of {} differs from the one in the store under the same key: the method "
                    "{} is not reproducible, or its revision was not raised",
                    record.key, record.name));
  }
}

/// Makes the folder of a packing and syncs the folder above, as a row must not outlive the name of its packing.
void make_durable_folder(const fs::path& folder) {
  if (!fs::create_directory(folder))
    return;
  const FileDescriptor above(file_system().open(folder.parent_path().c_str(), O_RDONLY | O_DIRECTORY, 0));
  if (!above || file_system().fsync(above.get()) != 0)
    throw system_error("cannot sync " + folder.parent_path().string(), errno);
}

} // namespace

Record Store::import_result(const fs::path& json, const fs::path& packing, const std::function<void(Record&)>& amend) {
  return with_disk_errors([&] {
    Record record = checked_record(json);
    if (amend)
      amend(record);
    record.packing_file.clear();
    if (!record.packing_sha256.empty()) {
      const fs::path home = packing_path(record.key);
      check_reproduced(record, find(record.key));
      // An import that was cut off has moved the packing already.
      const bool has_moved = !fs::exists(packing) && fs::exists(home);
      check_digest(has_moved ? home : packing, record);
      parts_->reached(ImportStep::verified);
      if (!has_moved) {
        make_durable_folder(home.parent_path());
        publish(packing, home);
      }
      record.packing_file = home.lexically_relative(parts_->folder).string();
      parts_->reached(ImportStep::packing_moved);
    }
    put(record);
    parts_->reached(ImportStep::committed);
    fs::remove(json);
    parts_->reached(ImportStep::done);
    return record;
  });
}

Sweep Store::sweep_incoming() {
  return with_disk_errors([&] {
    Sweep sweep;
    sweep.removed = remove_stale_temporaries(incoming());
    for (const fs::path& json : files_in(incoming(), ".json")) {
      fs::path packing = json;
      packing.replace_extension(".h5");
      try {
        sweep.imported.push_back(import_result(json, packing));
      } catch (const DamagedResult& e) {
        sweep.rejected.emplace_back(e.what());
        fs::remove(json);
        fs::remove(packing);
      }
    }
    // The record is written after the packing, so a packing alone is half a result.
    for (const fs::path& packing : files_in(incoming(), ".h5"))
      sweep.removed += fs::remove(packing) ? 1U : 0U;
    return sweep;
  });
}

} // namespace tamp
