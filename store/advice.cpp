// Says what the codes of SQLite mean for the folder of a store.
#include "store/store_parts.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>

namespace tamp {

namespace {

/// Errors of input and output that a full disk leads to; SQLite has one code of its own for the plainest case only.
constexpr std::array kFull = {SQLITE_FULL, SQLITE_IOERR_WRITE, SQLITE_IOERR_SHMSIZE, SQLITE_IOERR_FSYNC,
                              SQLITE_IOERR_TRUNCATE};

} // namespace

bool is_damage(const SQLite::Exception& error) {
  return error.getErrorCode() == SQLITE_CORRUPT || error.getErrorCode() == SQLITE_NOTADB;
}

std::string advice(const SQLite::Exception& error, const std::filesystem::path& file) {
  if (is_damage(error))
    return "; the file is damaged: `tamp fsck` saves what can be read of it";
  if (std::find(kFull.begin(), kFull.end(), error.getExtendedErrorCode()) != kFull.end()) {
    std::error_code unknown;
    const auto space = std::filesystem::space(file.parent_path(), unknown);
    const std::string free =
        unknown ? "" : fmt::format(": {:.1f} MB are free", static_cast<double>(space.available) / 1e6);
    return "; the disk may be full" + free + ". What is recorded is safe; the same command goes on once there is room";
  }
  return {};
}

} // namespace tamp
