// A campaign's jobs joined with their records: plain data, so that tables can be made without a database.
#pragma once

#include "engine/model/plan.h"
#include "engine/model/record.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// A metric of the campaign on one packing; no record if it has not run.
struct MetricRun {
  Metric metric;
  std::string key;
  std::optional<Record> record;
};

/// A job whose packing a run starts from, directly or through others.
struct Ancestor {
  std::string label; ///< of its row; its key if the plan does not have it
  std::string key;
  std::optional<Outcome> outcome; ///< none if it has not run
  Timing timing = {};
};

/// One generation job; no record if it has not run.
struct Run {
  PlannedJob planned;
  std::optional<Record> generation;
  std::vector<MetricRun> metrics; ///< in the order of the campaign
  std::vector<Ancestor> way = {}; ///< that its packing came, nearest first; empty if it starts from the scene

  /// Recorded with the outcome ok: only such runs enter a table's figures.
  [[nodiscard]] bool ok() const;

  /// A measure of the generator or of a metric that ended ok; the first of that name counts. Nothing for a number that
  /// is not finite.
  [[nodiscard]] std::optional<double> measure(std::string_view name) const;

  /// Key of the job at the start of the way; only runs with a common one share random numbers.
  [[nodiscard]] const std::string& origin() const { return way.empty() ? planned.key : way.back().key; }

  /// The ancestor that did not end ok, so that this job cannot run; nullptr if there is none.
  [[nodiscard]] const Ancestor* barrier() const;

  /// Wall-clock time of this generator and those before it on the way, s; nothing if one was not timed in this mode.
  [[nodiscard]] std::optional<double> way_seconds(TimingMode mode) const;
};

using FindRecord = std::function<std::optional<Record>(const std::string& key)>;

/// Every job of the plan, in its order.
std::vector<Run> collect_runs(const Plan& plan, const FindRecord& find);

/// Runs that differ in nothing but seed and replicate.
struct RunGroup {
  std::string heading; ///< label of the method; with the point of the sweep where one label has several groups
  std::string label;
  std::vector<Run> runs;

  [[nodiscard]] const Job& job() const { return runs.front().planned.job; }
  [[nodiscard]] std::size_t ok_count() const;
  /// The rows whose packings these start from, nearest first: "D&R", "relaxed, from D&R"; empty for the scene.
  [[nodiscard]] std::string start_in_words() const;
};

/// The groups, in the order of their first runs.
std::vector<RunGroup> group_runs(std::span<const Run> runs);

} // namespace tamp
