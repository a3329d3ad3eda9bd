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

/// One generation job; no record if it has not run.
struct Run {
  PlannedJob planned;
  std::optional<Record> generation;
  std::vector<MetricRun> metrics; ///< in the order of the campaign

  /// Recorded with the outcome ok: only such runs enter a table's figures.
  [[nodiscard]] bool ok() const;

  /// A measure of the generator or of a metric that ended ok; the first of that name counts. Nothing for a number that
  /// is not finite.
  [[nodiscard]] std::optional<double> measure(std::string_view name) const;
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
};

/// The groups, in the order of their first runs.
std::vector<RunGroup> group_runs(std::span<const Run> runs);

} // namespace tamp
