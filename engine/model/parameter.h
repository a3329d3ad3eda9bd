// Parameters declared once: type, unit, range, default and one line of documentation, bound to a field.
#pragma once

#include "engine/base/canonical_json.h"
#include "engine/model/job.h"
#include "engine/model/plan.h"

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

enum class ParameterKind { boolean, integer, number, choice, numbers };

/// Allowed values of a number (or of each number of a list).
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  [[nodiscard]] bool holds(double x) const {
    return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high);
  }
  /// In words: "above 0", "from 0 to 1", "any number".
  [[nodiscard]] std::string words() const;
};

/// One parameter of a Root (Scene, Method, Metric, RunSettings or ReportSettings). From these rows come validation,
/// canonical text, campaigns/schema.json and the reference page; nothing else knows a parameter's name.
template <class Root>
struct Parameter {
  std::string_view path; ///< inside the root, '/' between levels: "psd/mu_ln"
  std::string_view unit; ///< "1", "length", "ln(length)", "s", "MB"
  Range range;
  std::string_view doc;
  std::string_view when;        ///< in words, where it counts only sometimes: "law = lognormal"
  bool (*applies)(const Root&); ///< whether it counts, given the choices made above it in the table
  ParameterKind kind;
  std::vector<std::string_view> choices;           ///< of a choice
  std::function<JsonLeaf(const Root&)> get;        ///< NaN or an empty list: not stated
  std::function<void(Root&, const JsonLeaf&)> set; ///< the leaf has the kind's type and is a valid choice
};

std::span<const Parameter<Scene>> scene_parameters();
std::span<const Parameter<Method>> method_parameters(); ///< "name" first
std::span<const Parameter<Metric>> metric_parameters(); ///< "name" first
std::span<const Parameter<RunSettings>> run_parameters();
std::span<const Parameter<ReportSettings>> report_parameters(); ///< all but the list of tables

/// Whether a value means "not stated": NaN or an empty list.
bool is_unstated(const JsonLeaf& leaf);

/// The stated parameters that apply, as path → value below `prefix`.
template <class Root>
void collect(std::span<const Parameter<Root>> table, const Root& root, const std::string& prefix, JsonPaths& out) {
  for (const auto& row : table) {
    if (!row.applies(root))
      continue;
    if (JsonLeaf leaf = row.get(root); !is_unstated(leaf))
      out[prefix + std::string(row.path)] = std::move(leaf);
  }
}

} // namespace tamp
