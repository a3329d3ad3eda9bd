// Outcome: how a job ended. Every job ends in exactly one of these; only `ok` has measures worth a table.
// crashed: by a signal. cancelled: by somebody, on a cluster. lost: a cluster has neither the job nor a result of it.
#pragma once

#include "engine/model/enum_names.h"

namespace tamp {

enum class Outcome {
  ok,
  did_not_converge,
  memory_limited,
  time_limited,
  not_applicable,
  failed,
  crashed,
  cancelled,
  lost
};
template <>
struct EnumNames<Outcome> {
  static constexpr std::array<std::string_view, 9> value{"ok",           "did-not-converge", "memory-limited",
                                                         "time-limited", "not-applicable",   "failed",
                                                         "crashed",      "cancelled",        "lost"};
};

} // namespace tamp
