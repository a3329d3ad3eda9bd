// Starts `tamp job` (or whatever it is told to) under the limits of a job and judges how it ended.
#include "engine/schedule/process_executor.h"

#include "engine/base/error.h"
#include "engine/base/host.h"
#include "engine/schedule/disturbance.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <utility>

namespace tamp {

namespace {

/// Address space below which the program and its libraries may not even load: the kernel then ends it by SIGSEGV, or
/// the loader by this exit code.
constexpr std::uint64_t kProgramBytes = 64'000'000;
constexpr int kExitNotLoaded = 127;

/// Share of its budget that a job must have in use for its SIGKILL to be laid to the kernel's want of memory. A job
/// killed by hand has failed, and the next run tries it again.
constexpr double kMemorySuspect = 0.5;

/// Sanitizers reserve terabytes of address space, so a program built with one cannot run under a limit of it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

std::string signal_name(int signal) {
  const char* name = sigabbrev_np(signal);
  return name != nullptr ? fmt::format("SIG{}", name) : fmt::format("number {}", signal);
}

std::string with_tail(std::string reason, const std::string& log_tail) {
  const auto last = log_tail.find_last_not_of(" \n\t");
  if (last == std::string::npos)
    return reason;
  return fmt::format("{}; its last words:\n{}", reason, log_tail.substr(0, last + 1));
}

} // namespace

ProcessExecutor::ProcessExecutor(std::function<ChildJob(const Task&)> prepare, Provenance origin)
    : prepare_(std::move(prepare)), origin_(std::move(origin)) {}

std::optional<Record> ProcessExecutor::run(const Task& task, std::optional<int> core, std::stop_token stop) {
  const ChildJob child = prepare_(task);
  const std::string start = utc_now();
  const auto unfinished = [&](const Verdict& verdict) {
    Record record = blank_record(task.planned, origin_);
    record.outcome = verdict.outcome;
    record.reason = verdict.reason;
    record.provenance.start_utc = start;
    record.provenance.end_utc = utc_now();
    record.timing.mode = core ? TimingMode::exclusive : TimingMode::shared;
    record.limits = limits_of(task.run);
    return record;
  };
  ProcessResult result;
  try {
    result = run_process({.argv = child.argv,
                          .log = child.log,
                          .limits = {.wall_s = task.run.wall_s,
                                     .cpu_s = task.run.cpu_s,
                                     .memory_bytes = kLimitsMemory ? memory_bytes(task.run) : 0},
                          .core = core},
                         std::move(stop));
  } catch (const Error& error) {
    // The machine had no room for one more process just then; the next run tries again.
    return unfinished({Outcome::failed, error.what()});
  }

  std::optional<Record> record = child.collect(); // whole if there is one at all, so it counts however the child ended
  if (!record) {
    if (result.end == ProcessResult::End::cancelled)
      return std::nullopt;
    record = unfinished(judge_child(result, task.run));
  } else if (record->key != task.planned.key) {
    throw Error(fmt::format("the child that ran job {} left the record of job {}", task.planned.key, record->key));
  }
  record->timing.mode = core ? TimingMode::exclusive : TimingMode::shared;
  record->limits = limits_of(task.run);
  record->timing.process_wall_s = result.wall_s;
  record->timing.process_cpu_s = result.cpu_s;
  record->timing.peak_rss_bytes = result.peak_rss_bytes;
  settle_time(record->timing);
  return record;
}

Verdict judge_child(const ProcessResult& result, const RunSettings& run) {
  using End = ProcessResult::End;
  const auto no_memory = [&](std::string_view how) {
    return Verdict{Outcome::memory_limited, fmt::format("{} (budget {} MB)", how, run.memory_mb)};
  };
  const bool crashed = result.end == End::signalled || (result.end == End::exited && result.code == kExitNotLoaded);
  if (crashed && memory_bytes(run) < kProgramBytes)
    return no_memory("not even the program fits into the memory budget");
  switch (result.end) {
  case End::wall_limit:
    return {Outcome::time_limited,
            with_tail(fmt::format("not done after {:g} s, the budget of the job", run.wall_s), result.log_tail)};
  case End::cpu_limit:
    return {
        Outcome::time_limited,
        with_tail(fmt::format("not done after {:g} s of CPU time, the budget of the job", run.cpu_s), result.log_tail)};
  case End::signalled:
    if (result.code == SIGKILL &&
        static_cast<double>(result.peak_rss_bytes) >= kMemorySuspect * 1e6 * static_cast<double>(run.memory_mb))
      return no_memory("killed by SIGKILL with much memory in use, as the kernel does when memory runs out");
    return {Outcome::crashed, with_tail("ended by signal " + signal_name(result.code), result.log_tail)};
  case End::exited:
    if (result.code == kExitOutOfMemory)
      return no_memory("ran out of memory");
    return {Outcome::failed,
            with_tail(fmt::format("left no record and exited with code {}", result.code), result.log_tail)};
  case End::cancelled:
    break;
  }
  return {Outcome::failed, "cancelled"};
}

Limits limits_of(const RunSettings& run) {
  return {.wall_s = run.wall_s, .cpu_s = run.cpu_s, .memory_mb = run.memory_mb};
}

Record blank_record(const PlannedJob& planned, const Provenance& origin) {
  Record record;
  record.key = planned.key;
  record.kind = JobKind::generation;
  record.name = name_of(planned.job.method.name);
  record.revision = info(planned.job.method.name).revision;
  record.canonical = canonical(planned.job);
  record.parent = planned.job.parent;
  record.provenance = origin;
  return record;
}

} // namespace tamp
