// The error text of a failed system call, and closing descriptors.
#include "engine/base/system.h"

#include <unistd.h>

#include <system_error>

namespace tamp {

Error system_error(const std::string& what, int error_number) {
  return Error(what + ": " + std::generic_category().message(error_number) + " (errno " + std::to_string(error_number) +
               ")");
}

void FileDescriptor::reset() noexcept {
  // Linux frees the descriptor even if close() is interrupted, so it is never tried twice.
  if (fd_ >= 0)
    ::close(std::exchange(fd_, -1));
}

} // namespace tamp
