// The packings of a campaign as the page's script reads them: chosen within a budget, cut to a slab where they are
// many.
#pragma once

#include "report/report.h"

#include <string>

namespace tamp {

/// Spheres of one packing that a page shows at most: what a browser turns fluently.
inline constexpr std::size_t kMostSpheresShown = 30000;
/// Spheres of all packings of a page; with four doubles each, in base64, about 11 MB.
inline constexpr std::size_t kMostSpheresOfPage = 250000;

/// The section "packings": the controls, and one <script type="application/octet-stream;base64"> for each packing that
/// ended ok, first replicates first, until the budget is spent; what is left out is said. A packing of too many spheres
/// is cut at a height: all spheres that reach below it are there. Empty if no run ended ok or `input` cannot read
/// packings.
std::string packings_section(const ReportInput& input);

/// The part of a packing that is shown.
struct ShownPart {
  double height = 0;                ///< of the slab, from the floor; the box's own if all is shown
  std::vector<std::size_t> spheres; ///< ascending; those that reach into the slab, over a periodic face too
};

ShownPart shown_part(const Packing& packing, std::size_t most);

} // namespace tamp
