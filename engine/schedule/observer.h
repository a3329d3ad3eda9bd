// Watches a run, to show progress; it cannot change anything.
#pragma once

#include "engine/schedule/agenda.h"

namespace tamp {

/// Calls come one at a time, though from different threads, and must not block for long: the run waits for them.
class Observer {
public:
  virtual ~Observer() = default;
  /// Before anything starts; again if a further pass runs what others left.
  virtual void opened(const Agenda& /*agenda*/) {}
  virtual void started(const Item& /*item*/) {}
  /// The record has reached the sink.
  virtual void finished(const Item& /*item*/, const Record& /*record*/) {}
  /// The packing this job needs was not made, so it is not run.
  virtual void barred(const Item& /*item*/) {}
};

} // namespace tamp
