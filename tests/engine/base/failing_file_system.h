// A file system that lets one chosen call fail, to test what is left on the disk afterwards.
#pragma once

#include "engine/base/file_system.h"

#include <unistd.h>

#include <cerrno>
#include <string>

namespace tamp {

/// Lets the n-th call (counted from 1) of one kind fail with `error_number`; a failing write first writes half.
class FailingFileSystem : public FileSystem {
public:
  enum class Call { open, write, fsync, rename };

  FailingFileSystem(Call call, int nth, int error_number) : call_(call), nth_(nth), error_number_(error_number) {}

  int open(const char* path, int flags, mode_t mode) override {
    return fails(Call::open) ? -1 : FileSystem::open(path, flags, mode);
  }
  ssize_t write(int fd, const void* data, std::size_t size) override {
    if (!fails(Call::write))
      return FileSystem::write(fd, data, size);
    [[maybe_unused]] const auto half = FileSystem::write(fd, data, size / 2);
    errno = error_number_;
    return -1;
  }
  int fsync(int fd) override { return fails(Call::fsync) ? -1 : FileSystem::fsync(fd); }
  int rename(const char* from, const char* to) override {
    return fails(Call::rename) ? -1 : FileSystem::rename(from, to);
  }

  /// Whether the chosen call was ever reached.
  bool failed() const { return failed_; }

private:
  bool fails(Call call) {
    if (call != call_ || ++count_ != nth_)
      return false;
    failed_ = true;
    errno = error_number_;
    return true;
  }

  Call call_;
  int nth_;
  int error_number_;
  int count_ = 0;
  bool failed_ = false;
};

} // namespace tamp
