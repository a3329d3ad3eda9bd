// The seam to the file system: the calls by which results become durable, replaceable so that tests can make them fail.
#pragma once

#include <sys/types.h>

#include <cstddef>

namespace tamp {

/// The system calls that files.h makes. Each returns what the call of the same name does and sets errno on failure.
/// The base class is the real thing. Any thread may call; a replacement has to cope with that.
class FileSystem {
public:
  virtual ~FileSystem() = default;
  virtual int open(const char* path, int flags, mode_t mode);
  virtual ssize_t write(int fd, const void* data, std::size_t size);
  virtual int fsync(int fd);
  virtual int rename(const char* from, const char* to);
};

/// The file system in force: the real one unless a test has replaced it.
FileSystem& file_system();

/// Replaces the file system of this process while it lives. For tests; scopes may nest, but not overlap across threads.
class ScopedFileSystem {
public:
  explicit ScopedFileSystem(FileSystem& replacement);
  ~ScopedFileSystem();
  ScopedFileSystem(const ScopedFileSystem&) = delete;
  ScopedFileSystem& operator=(const ScopedFileSystem&) = delete;

private:
  FileSystem* previous_;
};

} // namespace tamp
