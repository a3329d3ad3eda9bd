// fcntl(2) with F_OFD_SETLK: unlike process-wide record locks, these belong to the one descriptor that took them.
#include "engine/base/claims.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <string>

namespace tamp {

namespace {

constexpr std::size_t kDigits = 15; // 60 bits, so that every key is a place in a file
constexpr off_t kPresence = off_t{1} << 61U;

off_t byte_of(std::string_view key) {
  std::uint64_t number = 0;
  const std::string_view digits = key.substr(0, kDigits);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number, 16);
  if (error != std::errc() || end != digits.data() + kDigits)
    throw Error("no key of a job: " + std::string(key));
  return static_cast<off_t>(number);
}

} // namespace

Claims::Claims(const std::filesystem::path& file)
    : file_(file), fd_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (!fd_)
    throw system_error("cannot open " + file.string(), errno);
}

bool Claims::lock(short type, off_t byte) {
  struct flock request {};
  request.l_type = type;
  request.l_whence = SEEK_SET;
  request.l_start = byte;
  request.l_len = 1;
  while (::fcntl(fd_.get(), F_OFD_SETLK, &request) != 0) {
    if (errno == EAGAIN || errno == EACCES)
      return false;
    if (errno != EINTR)
      throw system_error("cannot lock " + file_.string(), errno);
  }
  return true;
}

bool Claims::take(std::string_view key) {
  return lock(F_WRLCK, byte_of(key));
}

void Claims::give_back(std::string_view key) {
  lock(F_UNLCK, byte_of(key));
}

bool Claims::be_here() {
  return lock(F_RDLCK, kPresence);
}

bool Claims::be_alone() {
  return lock(F_WRLCK, kPresence);
}

void Claims::go() {
  lock(F_UNLCK, kPresence);
}

} // namespace tamp
