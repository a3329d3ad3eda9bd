// All metrics, the deepest overlaps and the spheres that touch nothing.
#include "campaigns/cli/audit.h"

#include "engine/base/error.h"
#include "engine/measure/measure.h"
#include "engine/measure/metrics.h"
#include "engine/model/random_close_packing.h"
#include "engine/search/packing_search.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp::cli {

namespace {

/// Keeps the deepest kShown; of equal depths the first.
void keep_deepest(std::vector<DeepOverlap>& worst, DeepOverlap overlap) {
  const auto deeper = [](const DeepOverlap& a, const DeepOverlap& b) { return a.depth > b.depth; };
  if (overlap.depth <= kOverlapTolerance || (worst.size() == kShown && !deeper(overlap, worst.back())))
    return;
  worst.insert(std::upper_bound(worst.begin(), worst.end(), overlap, deeper), std::move(overlap));
  if (worst.size() > kShown)
    worst.pop_back();
}

template <int D>
void look_at_contacts(Audit& audit, double contact_gap) {
  const Packing& packing = audit.read.packing;
  const auto search = search_of<D>(packing);
  std::vector<bool> touches(packing.count(), false);
  search.for_each_pair(contact_gap, [&](const SpherePair<D>& pair) {
    touches[pair.i] = touches[pair.j] = true;
    const double depth = -pair.gap / std::min(packing.radii[pair.i], packing.radii[pair.j]);
    keep_deepest(audit.worst, {audit.read.ids[pair.i], audit.read.ids[pair.j], "", depth});
  });
  search.for_each_wall(contact_gap, [&](const WallContact& wall) {
    touches[wall.i] = true;
    const auto axis = static_cast<std::size_t>(wall.axis);
    const double depth = -wall.gap / packing.radii[wall.i];
    if (depth > kOverlapTolerance) // a name for each of many contacts would take its time
      keep_deepest(audit.worst, {audit.read.ids[wall.i], 0,
                                 fmt::format("{} = {:g}", "xyz"[axis],
                                             audit.read.origin[axis] + (wall.side == 0 ? 0 : packing.size[axis])),
                                 depth});
  });
  for (std::size_t i = 0; i < packing.count(); ++i) {
    if (touches[i])
      continue;
    if (audit.floating.size() < kShown)
      audit.floating.push_back(audit.read.ids[i]);
    ++audit.floating_count;
  }
}

/// Larger packings are judged in seconds by all metrics but the equilibrium of all particles at once.
constexpr std::size_t kLoadedUpTo = 100000;

} // namespace

Audit audit(const std::string& file, ReadPacking read, const std::optional<StatedLaw>& law, double contact_gap) {
  Audit result;
  result.file = file;
  result.read = std::move(read);
  const Packing& packing = result.read.packing;
  result.fitted = !law.has_value();
  result.fit = fit_lognormal(packing.radii);
  result.law = law ? law->psd : law_of_fit(result.fit, packing.radii);
  result.law_words = law ? law->words : std::string(name_of(result.law.law));

  Scene scene;
  scene.dimension = packing.dimension;
  scene.unit = packing.unit;
  scene.psd = result.law;
  scene.size.assign(packing.size.begin(), packing.size.begin() + packing.dimension);
  for (const MetricInfo& info : metrics()) {
    if (!info.applies(result.law))
      continue;
    Metric metric;
    metric.name = info.name;
    metric.contact_gap = contact_gap;
    Finding finding{std::string(name_of(info.name)), {}, ""};
    if (info.name == MetricName::stable_loaded && packing.count() > kLoadedUpTo) {
      finding.why_not =
          fmt::format("left out above {} particles, where it would take longer than all others", kLoadedUpTo);
      result.findings.push_back(std::move(finding));
      continue;
    }
    try {
      finding.measures = measure(metric, packing, scene);
    } catch (const Error& e) {
      finding.why_not = e.what();
    }
    result.findings.push_back(std::move(finding));
  }
  with_dimension(packing.dimension, [&](auto d) { look_at_contacts<d>(result, contact_gap); });
  result.close_packing = random_close_packing(SizeLaw(result.law, packing.dimension), packing.dimension);
  return result;
}

std::optional<double> value_of(const Audit& audit, std::string_view measure) {
  for (const Finding& finding : audit.findings) {
    for (const Measure& m : finding.measures) {
      if (m.name == measure)
        return m.value;
    }
  }
  return std::nullopt;
}

} // namespace tamp::cli
