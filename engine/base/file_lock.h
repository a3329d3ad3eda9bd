// A lock between processes that the kernel frees when its holder dies, even by kill -9.
#pragma once

#include "engine/base/system.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>

namespace tamp {

/// Exclusive flock(2) on a file made for the purpose, held until the object goes. Also excludes another FileLock of the
/// same process. The file stays (removing it would let two processes hold "the" lock) and names its holder while held.
class FileLock {
public:
  /// The lock, or nothing if somebody holds it. Throws Error if the file cannot be made or opened.
  static std::optional<FileLock> try_lock(const std::filesystem::path& path);

  /// Waits at most `wait_s` seconds (0: does not wait), then throws Error "PATH is locked by process 123 on host x".
  static FileLock lock(const std::filesystem::path& path, double wait_s = std::numeric_limits<double>::infinity());

  /// Who holds the lock, for messages: "process 123 on host x", or "another process" if that cannot be read.
  static std::string holder(const std::filesystem::path& path);

  FileLock(FileLock&&) noexcept = default;
  FileLock& operator=(FileLock&&) noexcept = default;
  ~FileLock();

private:
  explicit FileLock(FileDescriptor fd) : fd_(std::move(fd)) {}
  FileDescriptor fd_;
};

} // namespace tamp
