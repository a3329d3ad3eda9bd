// Runs an agenda as a graph of tasks: generations wait in their own threads, metrics run as TBB tasks, records leave
// one by one.
#pragma once

#include "engine/schedule/agenda.h"
#include "engine/schedule/executor.h"
#include "engine/schedule/observer.h"
#include "engine/schedule/resources.h"

#include <functional>
#include <optional>
#include <stop_token>

namespace tamp {

/// The doors of a run to the outside.
struct Handlers {
  Executor& executor;
  /// Measures a stored packing; called from several threads at once. A packing that cannot be measured is an outcome
  /// of the record; anything thrown ends the run. Nothing if somebody else is at it.
  std::function<std::optional<Record>(const Task& task, const Metric& metric)> measure;
  /// Remembers a record; called for one record at a time. A metric job starts only after the record of its generation
  /// has gone through here. Anything thrown (disk full) ends the run.
  std::function<void(const Record& record)> sink;
  Observer& observer;
};

/// How a run went. Every item of the agenda is counted once.
struct Summary {
  OutcomeCounts ran{};       ///< in this run
  OutcomeCounts recorded{};  ///< before it
  std::size_t barred = 0;    ///< their packing was not made
  std::size_t cancelled = 0; ///< open at its end: the run was stopped, or somebody else is at them

  [[nodiscard]] bool all_ok() const;
};

/// Runs all open items. A shared job takes one core token and, a generation, its memory budget in memory tokens; an
/// exclusive generation takes all cores, so that no other job, metrics included, runs beside it. Ready metrics go
/// first, then generations in the order of the agenda, none overtaking another. Tokens come back after the sink.
///
/// When `stop` is requested nothing more starts, children are ended, metrics that run are finished and recorded. If
/// a handler throws, the run stops in the same way and the exception comes out here.
Summary run_agenda(const Agenda& agenda, const Resources& resources, const Handlers& handlers,
                   const std::stop_token& stop = {});

} // namespace tamp
