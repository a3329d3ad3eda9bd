// Makes the table of binary mixtures over the size ratio.
#include "report/bimodal_tables.h"
#include "report/cells.h"
#include "report/density_oracle.h"
#include "report/notes.h"
#include "report/paper_bimodal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

namespace tamp {

namespace {

constexpr std::array kCompared = {Quantity{"N_part", CellStyle::fixed, 0}, Quantity{"P_NL", CellStyle::fixed, 6},
                                  Quantity{"N_L", CellStyle::fixed, 0}, Quantity{"phi_paper"}}; // time stands last
constexpr std::array kOwn = {Quantity{"X_L"},
                             Quantity{"phi"},
                             Quantity{"phi_box"}, // left out where no group has it
                             Quantity{"N_PB", CellStyle::fixed, 0},
                             Quantity{"overlap_max", CellStyle::scientific, 0, Statistic::largest},
                             Quantity{"stable_alone", CellStyle::share, 0, Statistic::smallest},
                             Quantity{"z", CellStyle::fixed, 3}};

/// Fractions are stated, not measured.
constexpr double kSameFraction = 1e-12;

/// At size ratio 1 the fraction means nothing.
bool is_paper_mixture(const Scene& scene) {
  return scene.psd.size_ratio == 1 || agrees(scene.psd.large_volume_fraction, kPaperBimodalFraction, kSameFraction);
}

std::array<Cell, 5> paper_cells(const PaperBimodalRow& row) {
  if (!row.has_figures())
    return {word_cell(std::string(row.outcome)), {}, {}, {}, {}};
  Cell phi = printed_cell(row.phi);
  phi.doubtful = row.outcome != "ok";
  Cell time = time_cell(row.time_s.value);
  time.decimals = row.time_s.decimals;
  return {count_cell(static_cast<double>(row.particles)), printed_cell(row.large_share),
          count_cell(static_cast<double>(row.large)), phi, time};
}

/// A cell of the first panel for each of `kCompared`, and the time.
std::array<Cell, 5> run_cells(const RunGroup& runs) {
  if (runs.ok_count() == 0)
    return {word_cell(other_outcomes(runs)), {}, {}, {}, {}};
  std::array<Cell, 5> cells;
  for (std::size_t i = 0; i < kCompared.size(); ++i)
    cells[i] = quantity_cell(runs, kCompared[i]);
  cells.back() = time_cell(group_time(runs));
  return cells;
}

Group compared_group(const RunGroup& runs, const std::string& name) {
  const auto found = run_cells(runs);
  Group group{
      name, fmt::format("n = {}", runs.ok_count()) + start_remark(runs), {{"this run", {found.begin(), found.end()}}}};
  if (const std::string others = other_outcomes(runs); runs.ok_count() > 0 && !others.empty())
    group.remark += "; other runs: " + others;
  const Scene& scene = runs.job().scene;
  const PaperBimodalRow* row = find_paper_bimodal(runs.job().method, scene.psd.size_ratio);
  if (!row || !is_paper_mixture(scene))
    return group;
  group.remark += protocol_remark(runs);
  const auto printed = paper_cells(*row);
  Group::Line difference{"difference", {}};
  for (std::size_t i = 0; i < kCompared.size(); ++i)
    difference.cells.push_back(difference_cell(found[i], printed[i], i == 0 || i == 2));
  difference.cells.push_back(speed_cell(time_cell(way_time(runs)), printed.back()));
  group.lines.push_back({"paper", {printed.begin(), printed.end()}});
  if (row->has_figures() && runs.ok_count() > 0)
    group.lines.push_back(difference);
  return group;
}

std::vector<Quantity> own_quantities(std::span<const RunGroup> groups) {
  std::vector<Quantity> own;
  const bool whole = any_has(groups, "phi_box");
  std::copy_if(kOwn.begin(), kOwn.end(), std::back_inserter(own),
               [&](const Quantity& quantity) { return whole || quantity.symbol != "phi_box"; });
  return own;
}

Group own_group(const RunGroup& runs, const std::string& name, std::span<const Quantity> quantities,
                DensityOracle& oracle) {
  const Scene& scene = runs.job().scene;
  Group::Line line{"", {edge_cell(scene.size.front() * micrometres(scene.unit))}};
  for (const Quantity& quantity : quantities)
    line.cells.push_back(quantity_cell(runs, quantity));
  const auto cells = oracle_cells(runs, oracle);
  line.cells.insert(line.cells.end(), cells.begin(), cells.end());
  return {name, {}, {line}};
}

/// "D&R, ⟨rho⟩ = 10"; the group's own heading where that does not tell groups apart.
std::vector<std::string> names_of(std::span<const RunGroup> groups) {
  std::vector<std::string> names;
  std::map<std::string, int> uses;
  for (const RunGroup& group : groups) {
    names.push_back(fmt::format("{}, ⟨rho⟩ = {}", group.label, group.job().scene.psd.size_ratio));
    ++uses[names.back()];
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (uses[names[i]] > 1)
      names[i] = groups[i].heading;
  }
  return names;
}

std::vector<Note> own_notes() {
  return {
      {"Lines", fmt::format("\"this run\": mean ± sample standard deviation over the n replicates that ended ok. "
                            "\"paper\": the figure as printed in {}; a density in parentheses is one that the paper "
                            "calls anomalous. \"difference\": this run minus paper, for counts also in per cent; for "
                            "the time the factor paper / this run, between packings of different size: compare "
                            "⟨N_part⟩. Rows of methods that were not run are left out.",
                            kPaperCitation)},
      {"Columns",
       "⟨rho⟩ = ⟨R_L⟩/⟨R_S⟩. ⟨X⟩: edge of the box. ⟨N_part⟩: spheres in it, ⟨N_L⟩: large ones, ⟨P_NL⟩: their share by "
       "number, ⟨X_L⟩: by volume, as reached; the law asks for the fraction that \"What was run\" says. ⟨phi_paper⟩: "
       "the paper's estimator in the central sub-box, ⟨N_PB⟩: spheres centred in it; ⟨phi⟩: the exact packing "
       "fraction of that sub-box, ⟨phi_box⟩: of the whole box, where it is periodic on all sides. ⟨overlap_max⟩: "
       "deepest overlap relative to the smaller radius, ⟨stable_alone⟩: share "
       "in equilibrium with their neighbours held, both in the worst replicate. ⟨z⟩: mean number of contacts." +
           oracle_sentence()},
      {"⟨X_L⟩ reached",
       "Drawing a new radius after each sphere that does not fit (on_failure redraw, the paper's protocol) fills the "
       "box with small spheres once large ones no longer fit, so ⟨X_L⟩ comes out below the law's, and ⟨N_part⟩ above "
       "the paper's for as many large spheres. At size ratio 1 all spheres count as large, as in the paper."},
      {"Time of the paper", paper_time_sentence()}};
}

} // namespace

std::vector<RunGroup> bimodal_groups(std::span<const Run> runs) {
  std::vector<Run> chosen;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(chosen), [](const Run& run) {
    const Scene& scene = run.planned.job.scene;
    return scene.dimension == 3 && scene.psd.law == Law::bimodal;
  });
  std::vector<RunGroup> groups = group_runs(chosen);
  std::stable_sort(groups.begin(), groups.end(), [](const RunGroup& a, const RunGroup& b) {
    return a.job().scene.psd.size_ratio < b.job().scene.psd.size_ratio;
  });
  return groups;
}

Table bimodal_table(std::span<const RunGroup> groups) {
  Panel compared{"(a) The paper's columns", {}, {}};
  Panel own{"(b) What else was measured on the same packings", {{"X", "µm", ""}}, {}};
  for (const Quantity& quantity : kCompared)
    compared.columns.push_back(heading(quantity));
  compared.columns.push_back({"time", "", ""});
  const std::vector<Quantity> own_columns = own_quantities(groups);
  for (const Quantity& quantity : own_columns)
    own.columns.push_back(heading(quantity));
  const auto columns_of_oracle = oracle_columns();
  own.columns.insert(own.columns.end(), columns_of_oracle.begin(), columns_of_oracle.end());
  DensityOracle oracle;
  const std::vector<std::string> names = names_of(groups);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const bool ok = groups[i].ok_count() > 0;
    if (ok || !other_outcomes(groups[i]).empty())
      compared.groups.push_back(compared_group(groups[i], names[i]));
    if (ok)
      own.groups.push_back(own_group(groups[i], names[i], own_columns, oracle));
  }

  Table table;
  table.name = "bimodal_3d";
  table.caption =
      fmt::format("Binary mixtures in 3D over the size ratio: composition, packing fraction and cost, beside "
                  "the paper's table labelled {}.",
                  kPaperBimodalLabel);
  if (compared.groups.empty())
    return table;
  table.panels.push_back(compared);
  if (!own.groups.empty())
    table.panels.push_back(own);
  table.notes = own_notes();
  return table;
}

} // namespace tamp
