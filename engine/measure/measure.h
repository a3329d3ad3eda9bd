// The one interface of all metrics, and the table that lists them.
#pragma once

#include "engine/model/metric.h"
#include "engine/model/packing.h"
#include "engine/model/record.h"
#include "engine/model/scene.h"

#include <span>
#include <vector>

namespace tamp {

/// One row: `measure(metric, packing, scene)` returns named numbers. The scene is there for the law the radii should
/// follow; a metric never learns which method made the packing.
struct Measurement {
  MetricName name;
  std::vector<Measure> (*measure)(const Metric& metric, const Packing& packing, const Scene& scene);
};

std::span<const Measurement> measurements();

/// Runs one metric. Throws Error for a packing the metric cannot judge (an empty one), with the reason.
std::vector<Measure> measure(const Metric& metric, const Packing& packing, const Scene& scene);

} // namespace tamp
