// Metrics: what is measured on a packing, and the parameters of the measurement.
#pragma once

#include "engine/model/enum_names.h"
#include "engine/model/psd.h"

#include <cstdint>
#include <span>

namespace tamp {

enum class MetricName {
  hellinger,
  phi,
  phi_paper,
  overlap,
  stable_alone,
  coordination,
  composition,
  bond_order,
  stable_loaded
};
template <>
struct EnumNames<MetricName> {
  static constexpr std::array<std::string_view, 9> value{"hellinger",   "phi",          "phi_paper",
                                                         "overlap",     "stable_alone", "coordination",
                                                         "composition", "bond_order",   "stable_loaded"};
};

/// A metric with its parameters; each metric uses only its own.
struct Metric {
  MetricName name = MetricName::phi;
  std::int64_t bins = 80;    ///< hellinger: K equal bins between the smallest and the largest radius of the law
  double inset = 0.05;       ///< phi, phi_paper: share of each edge cut from each side of the sub-box
  double contact_gap = 1e-6; ///< stable_alone, stable_loaded, coordination: largest gap, relative to the smaller radius
  std::int64_t iterations = 4000; ///< stable_loaded: at most
  double friction = 0;            ///< stable_loaded: Coulomb's mu of every contact
};

/// What is known of a metric without running it. A revision goes up whenever the same packing would give other values.
struct MetricInfo {
  MetricName name;
  std::int64_t revision;
  std::string_view summary;
  bool (*applies)(const Psd& psd); ///< whether the metric has anything to say about spheres of such a law
};

std::span<const MetricInfo> metrics();
const MetricInfo& info(MetricName name);

} // namespace tamp
