// The names of the report's tables, so that a campaign file can be checked without knowing how a table is made.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace tamp {

struct ReportTableInfo {
  std::string_view name;
  std::string_view summary;
};

/// Every table that a campaign may ask for under `report/tables`; report/report.cpp has one maker for each.
inline constexpr std::array kReportTables = {
    ReportTableInfo{"powders", "the size laws: parameters, moments, quantiles, and how dense such particles can lie"},
    ReportTableInfo{"lognormal_2d",
                    "lognormal powder in 2D: PSD fidelity, packing fraction and time beside the paper's"},
    ReportTableInfo{"lognormal_3d",
                    "lognormal powder in 3D: PSD fidelity, packing fraction and time beside the paper's"},
    ReportTableInfo{"bimodal_3d", "binary mixtures in 3D over the size ratio: composition, density and time beside the "
                                  "paper's"},
    ReportTableInfo{"furnas", "packing fraction of binary mixtures over the share and the size of the large spheres"},
    ReportTableInfo{"domain_size", "one powder in boxes of many sizes: convergence, representative volume, scaling of "
                                   "the time"},
    ReportTableInfo{"accuracy", "what accuracy costs: error and time over each accuracy knob, orders of convergence, "
                                "cheapest settings for 1 %, 0.3 % and 0.1 %"},
    ReportTableInfo{"effects", "which effects were simulated, by which rule, and what leaving out the others saved"},
};

constexpr bool is_report_table(std::string_view name) {
  return std::any_of(kReportTables.begin(), kReportTables.end(),
                     [name](const ReportTableInfo& table) { return table.name == name; });
}

} // namespace tamp
