// Results for other programs: one row per generation job with all that was measured on its packing, as JSON or CSV.
#pragma once

#include "store/store.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// A generation job of a campaign that has run, with its measures and those of its metrics.
struct ResultRow {
  std::string campaign; ///< empty: no campaign names the job
  std::string label;
  std::int64_t replicate = 0;
  std::map<std::string, std::string> point;
  Record generation;
  /// Of the generation, then of the ok records of the metrics: those the campaign asks for, in its order; all, if no
  /// campaign names the job. If two metrics give one name, the later ones add their parameters: "H_N{bins=40}".
  std::vector<Measure> measures;
};

/// The rows of a campaign in the order of its file; an empty name gives those of every campaign and, at the end, the
/// jobs that no campaign names. Throws InputError for an unknown campaign, naming the known ones.
std::vector<ResultRow> results(const Store& store, std::string_view campaign);

/// An array of {key, campaign, method, label, parent (the key of the packing it starts from, or empty), scene,
/// parameters (of the method, with its revision), replicate, outcome, reason, time: {wall_s, cpu_s, peak_rss_bytes,
/// mode}, measures: {name: {value, unit}}}; scene and parameters are those of the canonical job.
std::string results_json(std::span<const ResultRow> rows);

/// The same as RFC 4180 text with a header line. The scene is spread over columns "scene/size", "scene/psd/law", …, the
/// parameters over "method/max_failures", …; a measure that has a unit names it in its column: "wall_gap [um]".
std::string results_csv(std::span<const ResultRow> rows);

} // namespace tamp
