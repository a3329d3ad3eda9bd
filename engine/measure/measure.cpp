// The table of metrics, and what every packing must satisfy before it is measured.
#include "engine/measure/measure.h"

#include "engine/base/error.h"
#include "engine/measure/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp {

namespace {

constexpr std::array kMeasurements = {
    Measurement{MetricName::hellinger, &measure_hellinger},
    Measurement{MetricName::phi, &measure_phi},
    Measurement{MetricName::phi_paper, &measure_phi_paper},
    Measurement{MetricName::overlap, &measure_overlap},
    Measurement{MetricName::stable_alone, &measure_stable_alone},
    Measurement{MetricName::coordination, &measure_coordination},
    Measurement{MetricName::composition, &measure_composition},
    Measurement{MetricName::bond_order, &measure_bond_order},
    Measurement{MetricName::stable_loaded, &measure_stable_loaded},
};

/// Throws Error unless the packing is one that every metric can work on.
void require_sound(const Packing& packing) {
  const auto d = static_cast<std::size_t>(packing.dimension);
  if (packing.dimension != 2 && packing.dimension != 3)
    throw Error(fmt::format("a packing in {} dimensions; allowed: 2 and 3", packing.dimension));
  if (packing.count() == 0)
    throw Error("an empty packing has nothing to measure");
  if (packing.positions.size() != packing.count() * d) {
    throw Error(fmt::format("a packing of {} radii in {} dimensions with {} coordinates", packing.count(), d,
                            packing.positions.size()));
  }
  const auto is_length = [](double x) { return std::isfinite(x) && x > 0; };
  for (std::size_t a = 0; a < d; ++a) {
    if (!is_length(packing.size[a]))
      throw Error(fmt::format("a packing whose box has the edge {}; allowed: lengths above 0", packing.size[a]));
  }
  for (std::size_t i = 0; i < packing.count(); ++i) {
    if (!is_length(packing.radii[i]))
      throw Error(fmt::format("sphere {} has the radius {}; allowed: lengths above 0", i, packing.radii[i]));
    for (std::size_t a = 0; a < d; ++a) {
      if (!std::isfinite(packing.positions[i * d + a]))
        throw Error(fmt::format("sphere {} has the coordinate {}", i, packing.positions[i * d + a]));
    }
  }
}

} // namespace

std::span<const Measurement> measurements() {
  return kMeasurements;
}

std::vector<Measure> measure(const Metric& metric, const Packing& packing, const Scene& scene) {
  require_sound(packing);
  const auto row = std::find_if(kMeasurements.begin(), kMeasurements.end(),
                                [&](const Measurement& m) { return m.name == metric.name; });
  if (row == kMeasurements.end())
    throw Error(fmt::format("no measurement of the name {}", name_of(metric.name)));
  return row->measure(metric, packing, scene);
}

} // namespace tamp
