// Runs generation jobs as child processes of this machine and turns whatever happens to a child into an outcome.
#pragma once

#include "engine/base/process.h"
#include "engine/schedule/executor.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tamp {

/// Exit code with which a child says that its memory budget was too small (std::bad_alloc under the limit).
inline constexpr int kExitOutOfMemory = 12;

/// One job as a child process.
struct ChildJob {
  std::vector<std::string> argv;
  std::filesystem::path log; ///< its output; the last lines go into the reason of a failure
  /// The record that the child left, if it left one. Called once, after the child has ended, however it ended.
  std::function<std::optional<Record>()> collect;
};

class ProcessExecutor final : public Executor {
public:
  /// `prepare` makes everything a child needs; called from several threads at once. `origin` is the provenance that
  /// the records of failed children get, but for the times.
  ProcessExecutor(std::function<ChildJob(const Task&)> prepare, Provenance origin);

  std::optional<Record> run(const Task& task, std::optional<int> core, std::stop_token stop) override;

private:
  std::function<ChildJob(const Task&)> prepare_;
  Provenance origin_;
};

/// How a child that left no record ended, and why, in words: "ended by signal SEGV", the budget it broke, its last
/// lines.
struct Verdict {
  Outcome outcome = Outcome::failed;
  std::string reason;
};
Verdict judge_child(const ProcessResult& result, const RunSettings& run);

/// The limits under which a job of these settings runs.
Limits limits_of(const RunSettings& run);

/// The record of a generation job before anything is known of its run: key, names, canonical text, origin.
Record blank_record(const PlannedJob& planned, const Provenance& origin);

} // namespace tamp
