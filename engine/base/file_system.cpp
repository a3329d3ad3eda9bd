// The real system calls behind the seam, and the pointer to the file system in force.
#include "engine/base/file_system.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>

namespace tamp {
namespace {

std::atomic<FileSystem*>& in_force() {
  static FileSystem real;
  static std::atomic<FileSystem*> pointer = &real;
  return pointer;
}

} // namespace

int FileSystem::open(const char* path, int flags, mode_t mode) {
  return ::open(path, flags | O_CLOEXEC, mode);
}
ssize_t FileSystem::write(int fd, const void* data, std::size_t size) {
  return ::write(fd, data, size);
}
int FileSystem::fsync(int fd) {
  return ::fsync(fd);
}
int FileSystem::rename(const char* from, const char* to) {
  return std::rename(from, to);
}

FileSystem& file_system() {
  return *in_force();
}

ScopedFileSystem::ScopedFileSystem(FileSystem& replacement) : previous_(in_force().exchange(&replacement)) {}
ScopedFileSystem::~ScopedFileSystem() {
  in_force() = previous_;
}

} // namespace tamp
