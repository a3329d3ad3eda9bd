// What every door to the operating system needs: an owned file descriptor, and errors that carry errno.
#pragma once

#include "engine/base/error.h"

#include <string>
#include <utility>

namespace tamp {

/// The error "what: text of errno (errno N)", for a system call that failed with `error_number`.
Error system_error(const std::string& what, int error_number);

/// Owns a file descriptor; closes it when it goes.
class FileDescriptor {
public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    if (this != &other) {
      reset();
      fd_ = std::exchange(other.fd_, -1);
    }
    return *this;
  }
  ~FileDescriptor() { reset(); }

  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }
  void reset() noexcept;

private:
  int fd_ = -1;
};

} // namespace tamp
