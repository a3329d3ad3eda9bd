// flock(2) with the holder's name written into the file for the message to those who find it locked.
#include "engine/base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <thread>

namespace tamp {
namespace {

// Polled, because a waiting flock cannot be given up after a time.
constexpr double pause_s = 0.02;

std::string own_name() {
  std::array<char, 65> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on host " + host.data() + '\n';
}

} // namespace

std::optional<FileLock> FileLock::try_lock(const std::filesystem::path& path) {
  // Close-on-exec, or a child would go on holding the lock of a parent that died.
  FileDescriptor fd(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (!fd)
    throw system_error("cannot open the lock " + path.string(), errno);
  while (::flock(fd.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK)
      return std::nullopt;
    if (errno != EINTR)
      throw system_error("cannot lock " + path.string(), errno);
  }
  // The name only serves messages: a full disk must not stand in the way of the lock.
  const std::string name = own_name();
  [[maybe_unused]] const bool named =
      ::ftruncate(fd.get(), 0) == 0 && ::pwrite(fd.get(), name.data(), name.size(), 0) > 0;
  return FileLock(std::move(fd));
}

FileLock FileLock::lock(const std::filesystem::path& path, double wait_s) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  for (;;) {
    if (auto lock = try_lock(path))
      return std::move(*lock);
    const double left = wait_s - std::chrono::duration<double>(Clock::now() - start).count();
    if (!(left > 0))
      throw Error(path.string() + " is locked by " + holder(path));
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left, pause_s)));
  }
}

std::string FileLock::holder(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string name;
  std::getline(file, name);
  return name.starts_with("process ") ? name : "another process";
}

FileLock::~FileLock() {
  // Emptied before it is freed, so that the next holder is not mistaken for this one in its first moments.
  if (fd_) [[maybe_unused]]
    const int emptied = ::ftruncate(fd_.get(), 0);
}

} // namespace tamp
