// Takes the numbers from the law itself, not from what was drawn.
#include "report/powders_table.h"

#include "engine/model/random_close_packing.h"
#include "engine/model/size_law.h"
#include "report/cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tamp {

namespace {

/// Lengths in µm, of which `um` make one of the law's.
std::string law_in_words(const Psd& psd, double um) {
  const auto length = [&](double value) { return fmt::format("{:.6g}", um * value); };
  switch (psd.law) {
  case Law::lognormal:
    return fmt::format("lognormal, ⟨mu_ln⟩ = {:.6g}, ⟨sigma_ln⟩ = {}", psd.mu_ln + std::log(um), psd.sigma_ln);
  case Law::bimodal:
    return fmt::format("bimodal, ⟨rho⟩ = {}, ⟨X_L⟩ = {}", psd.size_ratio, psd.large_volume_fraction);
  case Law::normal:
    return fmt::format("normal, mean {} µm, standard deviation {} µm", length(psd.mean), length(psd.sd));
  case Law::weibull:
    return fmt::format("Weibull, scale {} µm, shape {}", length(psd.scale), psd.shape);
  case Law::monodisperse:
  case Law::histogram:
    break;
  }
  return std::string(name_of(psd.law));
}

/// The radius below which half of the weight r^k is: the middle of where bisection ends.
double weighted_median(const SizeLaw& law, int k) {
  double low = law.smallest();
  double high = law.largest();
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high)
      return high;
    (law.weighted_cdf(middle, k) < 0.5 ? low : high) = middle;
  }
}

Cell number_cell(double value, std::string_view unit) {
  Cell cell;
  cell.value = value;
  cell.unit = unit;
  return cell;
}

Group row(const Scene& scene) {
  const auto dimension = static_cast<int>(scene.dimension);
  const SizeLaw law(scene.psd, dimension);
  const double um = micrometres(scene.unit);
  const double mean = law.moment(1);
  Group::Line line;
  for (const double length :
       {mean, std::sqrt(std::max(0.0, law.moment(2) - mean * mean)), law.quantile(0.1), law.quantile(0.5),
        law.quantile(0.9), weighted_median(law, dimension), law.smallest(), law.largest()})
    line.cells.push_back(number_cell(um * length, "um"));
  Cell densest = number_cell(random_close_packing(law, dimension), "1");
  densest.decimals = 3;
  line.cells.push_back(densest);
  return {fmt::format("{} ({}D)", law_in_words(scene.psd, um), dimension), {}, {line}};
}

} // namespace

Table powders_table(std::span<const Run> runs) {
  Panel panel{"Size laws, radii by number where nothing else is said", {}, {}, "Powder"};
  for (const char* length : {"r_mean", "r_sd", "r_10", "r_50", "r_90", "r_50_weighted", "r_min", "r_max"})
    panel.columns.push_back({length, "µm", {}});
  panel.columns.push_back({"phi_close", "1", {}});
  std::set<std::string> seen;
  for (const Run& run : runs) {
    Scene scene;
    const Scene& asked = run.planned.job.scene;
    scene.dimension = asked.dimension;
    scene.unit = asked.unit;
    scene.psd = asked.psd;
    Job powder = run.planned.job;
    powder.scene = scene;
    powder.method = {};
    powder.seed = 0;
    powder.replicate = 0;
    powder.parent.clear();
    if (seen.insert(canonical(powder)).second)
      panel.groups.push_back(row(scene));
  }
  Table table;
  table.name = "powders";
  table.caption = "Powders: parameters of the size laws, as they are cut and used.";
  table.panels.push_back(std::move(panel));
  table.notes = {
      {"Columns",
       "All lengths in µm, ⟨mu_ln⟩ of radii in µm. ⟨r_mean⟩, ⟨r_sd⟩: mean and standard deviation of the radii. ⟨r_10⟩, "
       "⟨r_50⟩, ⟨r_90⟩: radii that 10, 50 and 90 % "
       "of the particles do not exceed. ⟨r_50_weighted⟩: particles up to this radius hold half of the volume (2D: of "
       "the "
       "area). ⟨r_min⟩, ⟨r_max⟩: no other radii occur. ⟨phi_close⟩: packing fraction at which such particles are "
       "expected "
       "to jam at random: in 3D by R. S. Farr and R. D. Groot, J. Chem. Phys. 131, 244104 (2009), in 2D 0.84 for all "
       "laws."}};
  if (std::any_of(runs.begin(), runs.end(),
                  [](const Run& run) { return run.planned.job.scene.psd.law == Law::lognormal; }))
    table.notes.push_back(
        {"The paper's powder",
         "Its table prints mu_N 0.30, sigma_N 1.70, mean 1.30 µm, standard deviation 0.68 µm, radii from 0.1 to 50 µm "
         "and "
         "an experimental packing fraction of 0.62. By the identities of the lognormal law ⟨mu_ln⟩ = 0.30 and "
         "⟨sigma_ln⟩ = 0.68 give the mean 1.70 µm and the standard deviation 1.30 µm: its columns are permuted."});
  return table;
}

} // namespace tamp
