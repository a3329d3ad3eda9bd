// Asks the oracle once a powder.
#include "report/density_oracle.h"

#include "engine/model/random_close_packing.h"
#include "report/quantities.h"

#include <fmt/format.h>

#include <cmath>

namespace tamp {

namespace {

/// Overlaps up to this lift the density by less than a third of a per cent: a contact's volume counts twice.
constexpr double kShallow = 1e-3;
/// A share of large spheres further from the law's is another mixture.
constexpr double kSameMixture = 0.02;
/// More spheres in crystals are no random packing.
constexpr double kFewCrystals = 0.05;

/// What shows why a packing is denser than random ones can be.
std::string reason(const RunGroup& group) {
  const Summary overlap = summarize_measure(group, "overlap_max");
  const Summary large = summarize_measure(group, "X_L");
  const Summary crystals = summarize_measure(group, "crystalline");
  const Psd& psd = group.job().scene.psd;
  std::string found;
  const auto add = [&](const std::string& one) { found += (found.empty() ? "" : ", ") + one; };
  if (overlap.n > 0 && overlap.largest > kShallow)
    add(fmt::format("particles overlap by up to {:.2g} of their radius", overlap.largest));
  if (large.n > 0 && psd.size_ratio > 1 && std::abs(large.mean - psd.large_volume_fraction) > kSameMixture)
    add(fmt::format("another mixture: X_L {:.3f} instead of {:.3f}", large.mean, psd.large_volume_fraction));
  if (crystals.n > 0 && crystals.mean > kFewCrystals)
    add(fmt::format("{:.0f} % of the particles are in crystals (Q6 {:.3f})", 100 * crystals.mean,
                    summarize_measure(group, "Q6").mean));
  if (!found.empty())
    return found;
  return crystals.n == 0 ? "which the metrics measured do not explain (bond_order would tell crystals)"
                         : "which neither overlaps nor crystals explain";
}

} // namespace

double DensityOracle::operator()(const Scene& scene) {
  Job job; // whose canonical text names the powder
  job.scene = scene;
  job.scene.size.assign(static_cast<std::size_t>(scene.dimension), 1.0);
  job.scene.count = 0;
  const auto [place, is_new] = known_.emplace(canonical(job), 0);
  if (is_new) {
    const int dimension = static_cast<int>(scene.dimension);
    place->second = random_close_packing(SizeLaw(scene.psd, dimension), dimension);
  }
  return place->second;
}

std::array<Column, 2> oracle_columns() {
  return {Column{"phi_close", "1", {}}, Column{"phi_minus_close", "1", {}}};
}

std::array<Cell, 2> oracle_cells(const RunGroup& group, DensityOracle& oracle) {
  const Scene& scene = group.job().scene;
  if (scene.dimension != 3)
    return {};
  Cell expected;
  expected.value = oracle(scene);
  expected.decimals = 3;
  Cell distance = quantity_cell(group, Quantity{"phi"});
  if (distance.empty())
    return {expected, Cell{}};
  distance.value -= expected.value;
  distance.sign = true;
  distance.doubtful = distance.value > (std::isfinite(distance.spread) ? distance.spread : 0.0);
  return {expected, distance};
}

std::string above_in_words(std::span<const RunGroup> groups) {
  DensityOracle oracle;
  std::string words;
  for (const RunGroup& group : groups) {
    const Cell distance = oracle_cells(group, oracle)[1];
    if (!distance.doubtful)
      continue;
    words += fmt::format("{}{}: {:+.4f}, {}", words.empty() ? "" : "; ", group.heading, distance.value, reason(group));
  }
  return words.empty() ? words : words + ".";
}

std::string oracle_sentence() {
  return " ⟨phi_close⟩: random close packing expected of the law (Farr & Groot 2009); ⟨phi_minus_close⟩: distance of "
         "⟨phi⟩ to it, in parentheses where it is above by more than its standard deviation: such a packing is "
         "crystalline, overlaps (⟨overlap_max⟩), or holds another mixture than the law's.";
}

} // namespace tamp
