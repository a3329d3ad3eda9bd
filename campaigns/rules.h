// Every key a campaign file may hold, by its path: the parameter tables plus the few keys that belong to the file
// itself.
#pragma once

#include "campaigns/value.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// How often a campaign repeats each point.
struct Repeats {
  std::int64_t replicates = 1;
  std::int64_t seed = 1;
};
std::span<const Parameter<Repeats>> repeat_parameters();

/// A key at the top of the file.
struct TopKey {
  std::string_view name;
  bool required;
  std::string_view doc;
};
std::span<const TopKey> top_keys();

/// Keys beside the parameters.
inline constexpr std::string_view kFilePath = "psd/file"; ///< of a scene: stands for edges, weights and weighting
inline constexpr std::string_view kFileDoc =
    "CSV file of measured sizes, relative to the campaign file; stands for edges and weights (campaigns/README.md).";
inline constexpr std::string_view kLabelDoc = "Name of this entry in tables; default: the method's name.";
inline constexpr std::string_view kFromDoc =
    "Label of an entry further up: this method starts from that entry's packing of the same point and replicate.";
inline constexpr std::string_view kGridDoc = "Every combination of the listed values; the first path varies slowest.";
inline constexpr std::string_view kZipDoc = "Lists of equal length, walked together.";
inline constexpr std::string_view kPointsDoc = "Points written out one by one, each with its values.";
inline constexpr std::string_view kWhenDoc =
    "The block counts only where each path has one of its values and \"method\" is one of the labels or names.";
inline constexpr std::string_view kExcludeDoc = "Conditions like \"when\"; where one of them holds, nothing is made.";
inline constexpr std::string_view kIncludeDoc = "Points added to those of the block, whatever is excluded.";
inline constexpr std::string_view kDerivedDoc =
    "Values that follow from others: path and expression (+ - * / ^, parentheses, pi, sqrt, cbrt, log, exp, round, "
    "floor, ceil, names of parameters with dots: scene.psd.radius).";
inline constexpr std::string_view kTablesDoc = "Tables the report should contain.";
inline constexpr std::string_view kBudgetDoc = "What one job may take before it is stopped.";

/// The rule behind a sweepable path: "scene/…", "method/…" (but not its name), "replicates" or "seed"; nothing for
/// unknown paths and for "scene/psd/file", which has no leaf.
std::optional<ValueRule> sweep_rule(std::string_view path);

/// All sweepable paths, "scene/psd/file" included, in the order of the tables.
const std::vector<std::string>& sweep_paths();

/// Paths of a table's rows.
template <class Root>
std::vector<std::string> paths_of(std::span<const Parameter<Root>> table) {
  std::vector<std::string> out;
  for (const auto& row : table)
    out.emplace_back(row.path);
  return out;
}

/// The row of a path; null if there is none.
template <class Root>
const Parameter<Root>* find_row(std::span<const Parameter<Root>> table, std::string_view path) {
  for (const auto& row : table) {
    if (row.path == path)
      return &row;
  }
  return nullptr;
}

} // namespace tamp
