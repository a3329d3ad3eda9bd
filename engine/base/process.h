// Runs child processes under limits, so that a crash, a hang or a memory hog is a result and not the end of the caller.
#pragma once

#include "engine/base/system.h"

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace tamp {

/// What a child may use; 0 means unlimited.
struct ProcessLimits {
  double wall_s = 0;              ///< Watched by wait(), counted from the start of the child.
  double cpu_s = 0;               ///< RLIMIT_CPU, rounded up to whole seconds; each descendant has its own account.
  std::uint64_t memory_bytes = 0; ///< RLIMIT_AS: address space, so stacks of threads count. Allocations beyond it fail.
};

/// What to run; made by designated initialisers: {.argv = {"true"}, .log = "log"}. stdin is /dev/null; no other
/// descriptor of the caller is inherited; core dumps are off.
struct ProcessRequest {
  std::vector<std::string> argv = {}; ///< argv[0] is looked up in PATH unless it contains a slash.
  std::filesystem::path log = {};     ///< Receives stdout and stderr, emptied first; discarded if the path is empty.
  ProcessLimits limits = {};
  std::optional<int> core = {}; ///< Pins the child to this core (a number from usable_cores() of host.h).
  std::vector<std::pair<std::string, std::string>> environment =
      {};             ///< Added to, or replacing, the caller's variables.
  double grace_s = 2; ///< Time between SIGTERM and SIGKILL on cancellation or at the wall limit.
};

/// How a child ended and what it used (its waited-for descendants included).
struct ProcessResult {
  enum class End { exited, signalled, wall_limit, cpu_limit, cancelled };
  End end = End::exited;
  int code = 0; ///< Exit code if it left by exit() (also after a polite SIGTERM), else the signal that ended it.
  double wall_s = 0;
  double cpu_s = 0; ///< User and system time.
  /// Peak resident memory. Exact above the memory this process itself held when it forked (the kernel counts that copy
  /// too); below it the last of the samples of VmHWM taken while waiting, at intervals from 1 ms doubling to 100 ms.
  std::uint64_t peak_rss_bytes = 0;
  std::string log_tail; ///< Whole last lines of the log, 4 KiB at most; empty if the output was discarded.

  bool succeeded() const { return end == End::exited && code == 0; }
};

/// A running child, leader of a process group of its own. It is killed when this process dies, by whatever cause.
///
/// Once the child itself has ended, whatever is left of its group is killed; a descendant that left the group (setsid,
/// or a ChildProcess of its own, which dies with its parent) is not. One thread at a time may use an object; different
/// objects are independent. Not for use in a process that was itself forked without exec. Linux >= 5.3.
class ChildProcess {
public:
  /// Starts the child; returns once the program has been loaded. Throws Error (with errno) if it cannot be.
  static ChildProcess start(const ProcessRequest& request);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess(); ///< Kills the group and reaps the child, if wait() has not.

  /// Waits for the end; at the wall limit or when `stop` is requested: SIGTERM to the group, the grace, SIGKILL.
  /// May be called once.
  ProcessResult wait(std::stop_token stop = {});

  /// The child's pid, which is also its group; -1 once it has been reaped.
  pid_t pid() const { return pid_; }

private:
  using Clock = std::chrono::steady_clock;
  enum class Event { ended, deadline, stopped };

  ChildProcess() = default;
  Event watch(Clock::time_point deadline, int stop_fd);
  ProcessResult collect(Event event);
  void signal_group(int signal) const noexcept;
  void kill_and_reap() noexcept;

  pid_t pid_ = -1;
  FileDescriptor pidfd_;
  Clock::time_point start_;
  ProcessLimits limits_;
  double grace_s_ = 0;
  std::filesystem::path log_;
  std::uint64_t inherited_rss_bytes_ = 0;
  std::uint64_t sampled_rss_bytes_ = 0;
};

/// Starts a child and waits for it.
ProcessResult run_process(const ProcessRequest& request, std::stop_token stop = {});

} // namespace tamp
