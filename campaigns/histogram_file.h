// Measured sizes from a CSV file, as the classes of a histogram law.
#pragma once

#include "engine/model/psd.h"
#include "engine/model/scene.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace tamp {

/// Classes of radii. Lengths are in `unit` if the header names one, else in the scene's unit.
struct MeasuredSizes {
  std::vector<double> edges; ///< K + 1 radii, increasing
  std::vector<double> weights;
  std::optional<LengthUnit> unit;
  std::optional<Weighting> weighting; ///< if the header says what the weights count

  /// The edges in another unit.
  [[nodiscard]] std::vector<double> edges_in(LengthUnit target) const;
};

/// Reads measured sizes; the format is in campaigns/README.md. A single column of n sizes becomes ⌈2·n^(1/3)⌉ classes
/// (Rice's rule) of equal width in log(radius), counted by number. Throws InputError: "FILE:LINE: what is wrong".
MeasuredSizes read_measured_sizes(const std::filesystem::path& file);

/// The same for text in memory; `name` is the file's name in messages.
MeasuredSizes parse_measured_sizes(std::string_view text, const std::string& name);

} // namespace tamp
