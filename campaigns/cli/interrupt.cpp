// A handler that only writes to an event descriptor, and a thread that reads it and requests the stop.
#include "campaigns/cli/interrupt.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>

namespace tamp::cli {

namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM};
constexpr std::uint64_t kSignalled = 1;
constexpr std::uint64_t kClosing = std::uint64_t{1} << 32U; // beyond any count of signals

volatile std::sig_atomic_t event_fd = -1;

void on_signal(int /*signal*/) {
  const int saved = errno;
  [[maybe_unused]] const ssize_t written = ::write(event_fd, &kSignalled, sizeof kSignalled);
  errno = saved;
}

} // namespace

Interrupt::Interrupt() : event_(::eventfd(0, EFD_CLOEXEC)) {
  if (!event_)
    throw system_error("cannot make an event descriptor", errno);
  event_fd = event_.get();
  thread_ = std::jthread([this] {
    std::uint64_t count = 0;
    while (::read(event_.get(), &count, sizeof count) < 0 && errno == EINTR)
      continue;
    if (count % kClosing != 0)
      source_.request_stop();
  });
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND); // the next one finds the default: the end
  for (const int signal : kSignals)
    ::sigaction(signal, &action, nullptr);
}

Interrupt::~Interrupt() {
  for (const int signal : kSignals)
    std::signal(signal, SIG_DFL);
  [[maybe_unused]] const ssize_t written = ::write(event_.get(), &kClosing, sizeof kClosing);
}

} // namespace tamp::cli
