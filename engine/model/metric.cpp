// The table of metrics and their revisions.
#include "engine/model/metric.h"

#include <array>

namespace tamp {

namespace {

constexpr auto every_law = [](const Psd&) { return true; };
constexpr auto bimodal = [](const Psd& psd) { return psd.law == Law::bimodal; };

constexpr std::array kMetrics = {
    MetricInfo{MetricName::hellinger, 2,
               "Hellinger distance of the radii to the law: H_N, H_S (2D) or H_V (3D), and their sampling floor",
               every_law},
    MetricInfo{MetricName::phi, 2, "packing fraction of the sub-box, exact: sphere∩box volumes with edges and corners",
               every_law},
    MetricInfo{MetricName::phi_paper, 1, "packing fraction by the paper's clipped estimator, and N_PB", every_law},
    MetricInfo{MetricName::overlap, 1, "largest overlap relative to the smaller radius, and how many pairs overlap",
               every_law},
    MetricInfo{MetricName::stable_alone, 1, "share of spheres in equilibrium when looked at alone, neighbours held",
               every_law},
    MetricInfo{MetricName::coordination, 2, "mean number of contacts a sphere, with and without rattlers", every_law},
    MetricInfo{MetricName::composition, 1,
               "number N_L of the large spheres of a bimodal law, their share X_L by volume and P_NL by number",
               bimodal},
    MetricInfo{MetricName::bond_order, 1, "six-fold bond-orientational order, and the share of spheres in crystals",
               every_law},
    MetricInfo{
        MetricName::stable_loaded, 1,
        "whether contact forces can balance the weight of all spheres at once, and what is left where they cannot",
        every_law},
};

} // namespace

std::span<const MetricInfo> metrics() {
  return kMetrics;
}

const MetricInfo& info(MetricName name) {
  return kMetrics[static_cast<std::size_t>(name)];
}

} // namespace tamp
