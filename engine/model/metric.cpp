// The table of metrics and their revisions.
#include "engine/model/metric.h"

#include <array>

namespace tamp {

namespace {

constexpr std::array kMetrics = {
    MetricInfo{MetricName::hellinger, 1,
               "Hellinger distance of the radii to the law: H_N, H_S (2D) or H_V (3D), and their sampling floor"},
    MetricInfo{MetricName::phi, 1, "packing fraction of the sub-box, exact: sphere∩box volumes with edges and corners"},
    MetricInfo{MetricName::phi_paper, 1, "packing fraction by the paper's clipped estimator, and N_PB"},
    MetricInfo{MetricName::overlap, 1, "largest overlap relative to the smaller radius, and how many pairs overlap"},
    MetricInfo{MetricName::stable_alone, 1, "share of spheres in equilibrium when looked at alone, neighbours held"},
    MetricInfo{MetricName::coordination, 1, "mean number of contacts a sphere, with and without rattlers"},
};

} // namespace

std::span<const MetricInfo> metrics() {
  return kMetrics;
}

const MetricInfo& info(MetricName name) {
  return kMetrics[static_cast<std::size_t>(name)];
}

} // namespace tamp
