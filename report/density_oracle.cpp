// Asks the oracle once a powder.
#include "report/density_oracle.h"

#include "engine/model/random_close_packing.h"
#include "report/quantities.h"

namespace tamp {

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
  distance.doubtful = distance.value > (distance.n > 1 ? distance.spread : 0.0);
  return {expected, distance};
}

std::string oracle_sentence() {
  return " ⟨phi_close⟩: random close packing expected of the law (Farr & Groot 2009); ⟨phi_minus_close⟩: distance of "
         "⟨phi⟩ to it, in parentheses where it is above by more than its standard deviation: such a packing is "
         "crystalline, overlaps (⟨overlap_max⟩), or holds another mixture than the law's.";
}

} // namespace tamp
