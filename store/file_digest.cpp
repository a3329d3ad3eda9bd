// Hashes a file through a read-only mapping.
#include "store/file_digest.h"

#include "engine/base/sha256.h"
#include "engine/base/system.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <cerrno>
#include <string_view>

namespace tamp {

std::string file_sha256(const std::filesystem::path& path) {
  const FileDescriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat facts {};
  if (!fd || ::fstat(fd.get(), &facts) != 0)
    throw system_error("cannot read " + path.string(), errno);
  if (facts.st_size == 0)
    return sha256_hex({});
  const auto size = static_cast<std::size_t>(facts.st_size);
  void* bytes = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd.get(), 0);
  if (bytes == MAP_FAILED)
    throw system_error("cannot map " + path.string(), errno);
  std::string digest = sha256_hex(std::string_view(static_cast<const char*>(bytes), size));
  ::munmap(bytes, size);
  return digest;
}

} // namespace tamp
