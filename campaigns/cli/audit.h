// Judges a packing that any program may have made, by all metrics.
#pragma once

#include "campaigns/cli/audit_law.h"
#include "engine/model/metric.h"
#include "engine/model/record.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tamp::cli {

/// Two spheres, or a sphere and a wall, that reach into each other; numbers are those of the file.
struct DeepOverlap {
  std::int64_t a = 0;
  std::int64_t b = 0; ///< of no account for a wall
  std::string wall;   ///< "x = 0"; empty for a pair
  double depth = 0;   ///< relative to the smaller radius
};

/// What one metric said, or why it said nothing.
struct Finding {
  std::string metric;
  std::vector<Measure> measures;
  std::string why_not;
};

struct Audit {
  std::string file;
  ReadPacking read;
  Psd law; ///< stated, or that of the fit
  bool fitted = true;
  std::string law_words;
  LognormalFit fit;
  std::vector<Finding> findings;      ///< in the order of the table of metrics
  std::vector<DeepOverlap> worst;     ///< deepest first, kShown at most
  std::vector<std::int64_t> floating; ///< spheres that touch nothing, kShown at most
  std::uint64_t floating_count = 0;
  std::optional<double> close_packing; ///< random close packing of the law
};

/// Overlaps and floating spheres that are listed.
inline constexpr std::size_t kShown = 10;

/// Runs all metrics that apply to the law; without a law, that of a fitted lognormal. `contact_gap`: see Metric.
Audit audit(const std::string& file, ReadPacking read, const std::optional<StatedLaw>& law, double contact_gap);

/// The value of a measure; nothing if it was not found.
std::optional<double> value_of(const Audit& audit, std::string_view measure);

std::string audit_text(const Audit& audit);
/// Quantities down, files across.
std::string comparison_of(const std::vector<Audit>& audits);
/// {"audits":[…]}
std::string audit_json(const std::vector<Audit>& audits);

} // namespace tamp::cli
