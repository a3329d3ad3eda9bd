// Agenda: everything some campaigns ask for as one list of jobs, and which of them are still to be run.
#pragma once

#include "engine/model/plan.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tamp {

/// One packing that is wanted: the generation job, how it runs, and what is measured on it.
struct Task {
  PlannedJob planned;
  RunSettings run;
  std::vector<Metric> metrics;
};

/// The memory budget of a job in bytes.
constexpr std::uint64_t memory_bytes(const RunSettings& run) {
  constexpr std::uint64_t kBytesPerMb = 1'000'000;
  return static_cast<std::uint64_t>(run.memory_mb) * kBytesPerMb;
}

/// recorded: nothing to do. open: to be run. barred: cannot run, as the packing it needs was not made.
enum class Standing { recorded, open, barred };

/// A generation or metric job; the unit that is scheduled, recorded and counted.
struct Item {
  JobKind kind = JobKind::generation;
  std::string key;
  std::size_t task = 0;             ///< index into Agenda::tasks
  std::size_t metric = 0;           ///< index into Task::metrics; metric jobs only
  std::optional<std::size_t> after; ///< the item that makes the packing this one starts from or measures
  Standing standing = Standing::open;
  std::optional<Outcome> recorded; ///< how it ended, if recorded
};

struct Agenda {
  std::vector<Task> tasks;
  std::vector<Item> items; ///< each task's generation, then its metrics; an item comes behind the one it waits for

  [[nodiscard]] const Task& task(const Item& item) const { return tasks[item.task]; }
  [[nodiscard]] const Metric& metric(const Item& item) const { return tasks[item.task].metrics[item.metric]; }
  [[nodiscard]] std::size_t count(Standing standing) const;
};

/// Number of jobs per outcome, in the order of the enumeration.
using OutcomeCounts = std::array<std::size_t, EnumNames<Outcome>::value.size()>;

/// How many items are recorded with each outcome.
OutcomeCounts recorded_outcomes(const Agenda& agenda);

/// How the job of a key is recorded to have ended; nothing if it is not recorded.
using Known = std::function<std::optional<Outcome>(const std::string& key)>;

/// Whether a generation job that ended so left a packing behind.
constexpr bool leaves_packing(Outcome outcome) {
  return outcome == Outcome::ok || outcome == Outcome::did_not_converge;
}

/// Joins campaigns. A job that several of them ask for is run once: with the larger budgets, exclusively if any wants
/// that, for the metrics of all. Parents are put before their children. Throws Error for a job whose parent is neither
/// planned nor recorded.
Agenda make_agenda(std::span<const Plan> plans, const Known& known);

} // namespace tamp
