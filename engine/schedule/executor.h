// The seam to whatever runs a generation job: child processes here, mocks in tests.
#pragma once

#include "engine/schedule/agenda.h"

#include <optional>
#include <stop_token>

namespace tamp {

class Executor {
public:
  virtual ~Executor() = default;

  /// Runs the generation job of a task to its end and returns its record; whatever happens to the job is an outcome of
  /// that record. Nothing if `stop` ended it first, or if somebody else is at it. `core`: run pinned to this core,
  /// timed exclusively. Blocks; called from several threads at once. Throws Error only if no job at all can be run;
  /// that ends the run.
  virtual std::optional<Record> run(const Task& task, std::optional<int> core, std::stop_token stop) = 0;
};

} // namespace tamp
