// Waits for a child on its pidfd, enforces the wall limit and cancellation, and gathers what it used.
#include "engine/base/process.h"

#include "engine/base/host.h"
#include "engine/base/spawn.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <stdexcept>

namespace tamp {
namespace {

using std::chrono::duration;
using std::chrono::duration_cast;
using std::chrono::nanoseconds;

constexpr std::streamoff log_tail_bytes = 4096;
constexpr nanoseconds shortest_pause = std::chrono::milliseconds(1);
constexpr nanoseconds longest_pause = std::chrono::milliseconds(100);
constexpr double longest_limit_s = 1e9; // Beyond some thirty years a limit is none, and a time point could overflow.
constexpr std::uint64_t rss_slack_bytes = 512 * 1024; // Pages touched between the child's own reading and its exec.

std::chrono::steady_clock::time_point later(std::chrono::steady_clock::time_point start, double seconds) {
  if (!(seconds < longest_limit_s))
    return std::chrono::steady_clock::time_point::max();
  return start + duration_cast<nanoseconds>(duration<double>(std::max(seconds, 0.0)));
}

double in_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// The end of a log, from the start of a line on if it had to be cut.
std::string tail_of(const std::filesystem::path& path) {
  if (path.empty())
    return {};
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file)
    return {};
  const auto size = static_cast<std::streamoff>(file.tellg());
  const auto length = std::min(size, log_tail_bytes);
  std::string text(static_cast<std::size_t>(std::max<std::streamoff>(length, 0)), '\0');
  file.seekg(size - length);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (size > length)
    if (const auto newline = text.find('\n'); newline + 1 < text.size())
      text.erase(0, newline + 1);
  return text;
}

} // namespace

ChildProcess ChildProcess::start(const ProcessRequest& request) {
  SpawnedChild spawned = spawn(request);
  ChildProcess child;
  child.pid_ = spawned.pid;
  child.pidfd_ = std::move(spawned.pidfd);
  child.start_ = spawned.start;
  child.limits_ = request.limits;
  child.grace_s_ = request.grace_s;
  child.log_ = request.log;
  child.inherited_rss_bytes_ = spawned.inherited_rss_bytes;
  child.sampled_rss_bytes_ = peak_rss_bytes(child.pid_);
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept {
  *this = std::move(other);
}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  if (this == &other)
    return *this;
  kill_and_reap();
  pid_ = std::exchange(other.pid_, -1);
  pidfd_ = std::move(other.pidfd_);
  start_ = other.start_;
  limits_ = other.limits_;
  grace_s_ = other.grace_s_;
  log_ = std::move(other.log_);
  inherited_rss_bytes_ = other.inherited_rss_bytes_;
  sampled_rss_bytes_ = other.sampled_rss_bytes_;
  return *this;
}

ChildProcess::~ChildProcess() {
  kill_and_reap();
}

void ChildProcess::signal_group(int signal) const noexcept {
  ::kill(-pid_, signal);
}

void ChildProcess::kill_and_reap() noexcept {
  if (pid_ <= 0)
    return;
  signal_group(SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR)
    continue;
  pid_ = -1;
}

/// Sleeps until the child has ended, the deadline has passed or `stop_fd` (if not -1) is readable.
ChildProcess::Event ChildProcess::watch(Clock::time_point deadline, int stop_fd) {
  for (nanoseconds pause = shortest_pause;; pause = std::min(2 * pause, longest_pause)) {
    sampled_rss_bytes_ = std::max(sampled_rss_bytes_, peak_rss_bytes(pid_));
    const auto now = Clock::now();
    const auto left = std::clamp<nanoseconds>(deadline - now, nanoseconds(0), pause);
    const timespec timeout{0, static_cast<long>(left.count())};
    std::array<pollfd, 2> watched{pollfd{pidfd_.get(), POLLIN, 0}, pollfd{stop_fd, POLLIN, 0}};
    if (::ppoll(watched.data(), watched.size(), &timeout, nullptr) < 0 && errno != EINTR)
      throw system_error("cannot wait for process " + std::to_string(pid_), errno);
    else if (watched[0].revents != 0)
      return Event::ended;
    else if (watched[1].revents != 0)
      return Event::stopped;
    else if (now >= deadline)
      return Event::deadline;
  }
}

ProcessResult ChildProcess::wait(std::stop_token stop) {
  if (pid_ <= 0)
    throw std::logic_error("ChildProcess::wait: there is no child to wait for");
  const FileDescriptor wake(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!wake)
    throw system_error("cannot make an event descriptor", errno);
  const std::stop_callback on_stop(stop, [&wake] { ::eventfd_write(wake.get(), 1); });

  const Event event = watch(limits_.wall_s > 0 ? later(start_, limits_.wall_s) : Clock::time_point::max(), wake.get());
  if (event != Event::ended) {
    signal_group(SIGTERM);
    signal_group(SIGCONT); // A stopped process would not see it.
    if (watch(later(Clock::now(), grace_s_), -1) != Event::ended) {
      signal_group(SIGKILL);
      watch(Clock::time_point::max(), -1);
    }
  }
  return collect(event);
}

ProcessResult ChildProcess::collect(Event event) {
  const auto end = Clock::now();
  // The rest of the group goes first: while the leader is not reaped, its number cannot name another group.
  signal_group(SIGKILL);
  int status = 0;
  rusage usage{};
  while (::wait4(pid_, &status, 0, &usage) < 0)
    if (errno != EINTR)
      throw system_error("cannot reap process " + std::to_string(std::exchange(pid_, -1)), errno);
  pid_ = -1;
  pidfd_.reset();

  ProcessResult result;
  result.wall_s = duration<double>(end - start_).count();
  result.cpu_s = in_seconds(usage.ru_utime) + in_seconds(usage.ru_stime);
  // ru_maxrss survives exec, so it also covers the copy of this process that the child was before.
  const auto reported = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  const bool exact = reported > inherited_rss_bytes_ + rss_slack_bytes || sampled_rss_bytes_ == 0;
  result.peak_rss_bytes = exact ? reported : sampled_rss_bytes_;
  result.log_tail = tail_of(log_);

  using End = ProcessResult::End;
  const bool signalled = WIFSIGNALED(status);
  result.code = signalled ? WTERMSIG(status) : WEXITSTATUS(status);
  const bool out_of_cpu = limits_.cpu_s > 0 && signalled &&
                          (result.code == SIGXCPU || (result.code == SIGKILL && result.cpu_s >= limits_.cpu_s));
  if (event == Event::stopped)
    result.end = End::cancelled;
  else if (event == Event::deadline)
    result.end = End::wall_limit;
  else if (out_of_cpu)
    result.end = End::cpu_limit;
  else
    result.end = signalled ? End::signalled : End::exited;
  return result;
}

ProcessResult run_process(const ProcessRequest& request, std::stop_token stop) {
  return ChildProcess::start(request).wait(std::move(stop));
}

} // namespace tamp
