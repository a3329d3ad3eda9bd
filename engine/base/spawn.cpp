// Forks from one thread that never ends, and carries out only async-signal-safe calls between fork and exec.
#include "engine/base/spawn.h"

#include "engine/base/spawn_plan.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <future>
#include <mutex>
#include <thread>

namespace tamp {
namespace {

enum class Step : int { loaded, process_group, parent_death, core, limits, streams, exec };

const char* describe(Step step) {
  switch (step) {
  case Step::loaded:
    return "start";
  case Step::process_group:
    return "make a process group for";
  case Step::parent_death:
    return "tie the life of this process to";
  case Step::core:
    return "pin to its core";
  case Step::limits:
    return "set the limits of";
  case Step::streams:
    return "redirect the output of";
  case Step::exec:
    return "execute";
  }
  return "start";
}

/// What the child tells its parent through a pipe: its memory just before exec, and after it the failure, if any.
struct Report {
  Step step = Step::loaded;
  int error_number = 0;
  long peak_rss_kib = 0;
};

/// The child's side. Between fork and exec of a multithreaded process only async-signal-safe calls are allowed: no
/// allocation, no lock, no exception.
[[noreturn]] void become(const SpawnPlan& plan, int pipe) noexcept {
  Report report;
  const auto fail = [&](Step step) {
    report.step = step;
    report.error_number = errno;
    [[maybe_unused]] const auto written = ::write(pipe, &report, sizeof report);
    ::_exit(127);
  };
  if (::setpgid(0, 0) != 0)
    fail(Step::process_group);
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0)
    fail(Step::parent_death);
  if (::getppid() != plan.parent)
    ::_exit(127); // The parent died before prctl took effect: nobody would tell us.
  if (plan.cores && ::sched_setaffinity(0, sizeof *plan.cores, &*plan.cores) != 0)
    fail(Step::core);
  const rlimit no_core_dump{};
  if (::setrlimit(RLIMIT_CORE, &no_core_dump) != 0)
    fail(Step::limits);
  if (plan.cpu && ::setrlimit(RLIMIT_CPU, &*plan.cpu) != 0)
    fail(Step::limits);
  if (plan.memory && ::setrlimit(RLIMIT_AS, &*plan.memory) != 0)
    fail(Step::limits);
  if (::dup2(plan.input.get(), STDIN_FILENO) < 0 || ::dup2(plan.output.get(), STDOUT_FILENO) < 0 ||
      ::dup2(plan.output.get(), STDERR_FILENO) < 0)
    fail(Step::streams);
  // Libraries open files without O_CLOEXEC (HDF5 does): none may leak, least of all one that holds a lock.
  if (::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC) != 0)
    for (rlim_t fd = STDERR_FILENO + 1; fd < plan.descriptors; ++fd)
      ::fcntl(static_cast<int>(fd), F_SETFD, FD_CLOEXEC);
  // Handlers of the parent must not run here, and ignored signals must not stay ignored in the program.
  struct sigaction by_default {};
  by_default.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal)
    ::sigaction(signal, &by_default, nullptr);
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  report.peak_rss_kib = usage.ru_maxrss;
  [[maybe_unused]] const auto written = ::write(pipe, &report, sizeof report);
  ::execve(plan.program.c_str(), plan.argv.data(), plan.envp.data());
  fail(Step::exec);
  ::_exit(127);
}

struct Forked {
  pid_t pid = -1;
  std::chrono::steady_clock::time_point start;
  FileDescriptor report;
};

Forked fork_child(const SpawnPlan& plan) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw system_error("cannot make a pipe for " + plan.program, errno);
  Forked forked;
  forked.report = FileDescriptor(ends[0]);
  FileDescriptor write_end(ends[1]);
  if (write_end.get() <= STDERR_FILENO) { // Only if the standard streams are closed; dup2 would overwrite it.
    write_end = FileDescriptor(::fcntl(ends[1], F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
    if (!write_end)
      throw system_error("cannot duplicate a pipe for " + plan.program, errno);
  }
  forked.start = std::chrono::steady_clock::now();
  forked.pid = ::fork();
  if (forked.pid < 0)
    throw system_error("cannot fork for " + plan.program, errno);
  if (forked.pid == 0)
    become(plan, write_end.get());
  return forked;
}

/// The one thread that forks. The death signal (PR_SET_PDEATHSIG) is sent when the *thread* that forked ends, not the
/// process, and the threads of a task pool may end at any time; so this one lives as long as the process. It is
/// detached and its state is never destroyed, hence it does not disturb the exit either.
class Spawner {
public:
  static Spawner& instance() {
    static auto* const spawner = new Spawner;
    return *spawner;
  }

  Forked fork(const SpawnPlan& plan) {
    std::packaged_task<Forked()> task([&plan] { return fork_child(plan); });
    auto forked = task.get_future();
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    waiting_.notify_one();
    return forked.get();
  }

private:
  Spawner() { std::thread(&Spawner::serve, this).detach(); }

  [[noreturn]] void serve() {
    // Blocked here, a signal goes to another thread, and none can reach a child before its exec.
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, nullptr);
    // Children inherit the cores of this thread; the thread that happened to start it may have been pinned.
    cpu_set_t cores;
    if (::sched_getaffinity(::getpid(), sizeof cores, &cores) == 0)
      ::sched_setaffinity(0, sizeof cores, &cores);
    for (;;) {
      std::unique_lock lock(mutex_);
      waiting_.wait(lock, [&] { return !tasks_.empty(); });
      auto task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
    }
  }

  std::mutex mutex_;
  std::condition_variable waiting_;
  std::deque<std::packaged_task<Forked()>> tasks_;
};

/// Reads the child's reports until its exec (or its death) closes the pipe; the last one counts.
Report read_report(int pipe, bool& complete) {
  Report report;
  Report next;
  complete = false;
  for (;;) {
    const auto count = ::read(pipe, &next, sizeof next); // Below PIPE_BUF: reports arrive whole.
    if (count < 0 && errno == EINTR)
      continue;
    if (count != static_cast<ssize_t>(sizeof next))
      return report;
    report = next;
    complete = true;
  }
}

} // namespace

SpawnedChild spawn(const ProcessRequest& request) {
  const SpawnPlan plan = make_spawn_plan(request);
  const Forked forked = Spawner::instance().fork(plan);
  bool complete = false;
  const Report report = read_report(forked.report.get(), complete);
  SpawnedChild child;
  child.pid = forked.pid;
  child.start = forked.start;
  child.inherited_rss_bytes = static_cast<std::uint64_t>(report.peak_rss_kib) * 1024;
  // Not by glibc's pidfd_open: the header of version 2.36 cannot be linked from C++.
  child.pidfd = FileDescriptor(static_cast<int>(::syscall(SYS_pidfd_open, forked.pid, 0)));
  const int pidfd_error = errno;
  if (complete && report.step == Step::loaded && child.pidfd)
    return child;

  ::kill(forked.pid, SIGKILL);
  while (::waitpid(forked.pid, nullptr, 0) < 0 && errno == EINTR)
    continue;
  if (!complete)
    throw Error("cannot start " + plan.program + ": the child died before it could load the program");
  if (report.step == Step::loaded)
    throw system_error("cannot watch " + plan.program, pidfd_error);
  throw system_error(std::string("cannot ") + describe(report.step) + ' ' + plan.program, report.error_number);
}

} // namespace tamp
