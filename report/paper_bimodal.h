// The figures of the paper's table of binary mixtures (its label tab:bimodal-3D), as printed.
#pragma once

#include "report/paper_tables.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace tamp {

inline constexpr std::string_view kPaperBimodalLabel = "tab:bimodal-3D";
/// Share of the large spheres' volume in all of the table's mixtures.
inline constexpr double kPaperBimodalFraction = 0.75;

/// One row. `outcome` is "ok", "anomalous" (the paper prints the density in parentheses) or the reason for which there
/// are no figures.
struct PaperBimodalRow {
  std::string_view method;
  double size_ratio;
  std::string_view outcome;
  std::int64_t particles = 0;
  Printed large_share{}; ///< P_NL
  std::int64_t large = 0;
  Printed phi{};
  Printed time_s{};

  [[nodiscard]] bool has_figures() const { return particles > 0; }
};

std::span<const PaperBimodalRow> paper_bimodal_rows();

/// The row of that name in the paper, and that which packings of a method stand beside; nullptr if the paper has none.
const PaperBimodalRow* find_paper_bimodal(std::string_view paper_name, double size_ratio);
const PaperBimodalRow* find_paper_bimodal(const Method& method, double size_ratio);

} // namespace tamp
