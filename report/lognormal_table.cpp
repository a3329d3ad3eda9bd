// Makes the rows of the lognormal tables.
#include "report/lognormal_table.h"

#include "report/cells.h"
#include "report/density_oracle.h"
#include "report/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace tamp {

namespace {

/// Edges are stated, not measured: what differs by more than the rounding of a change of units is another box.
constexpr double kSameEdge = 1e-12;

bool is_square_of(const Scene& scene, double edge_um) {
  return std::all_of(scene.size.begin(), scene.size.end(),
                     [&](double edge) { return agrees(edge * micrometres(scene.unit), edge_um, kSameEdge); });
}

bool has_equal_edges(const Scene& scene) {
  return !scene.size.empty() && is_square_of(scene, scene.size.front() * micrometres(scene.unit));
}

struct Columns {
  std::array<Quantity, 5> compared; ///< N_part, H_N, H_S or H_V, phi_paper, N_PB; time stands last
  std::vector<Quantity> own;
};

/// `whole`: whether there are packing fractions of whole boxes.
Columns columns_of(int dimension, bool whole) {
  const bool two = dimension == 2;
  Columns columns{
      {Quantity{"N_part", CellStyle::fixed, 0}, Quantity{"H_N"}, Quantity{two ? "H_S" : "H_V"}, Quantity{"phi_paper"},
       Quantity{"N_PB", CellStyle::fixed, 0}},
      {Quantity{"phi"}, Quantity{"bins", CellStyle::fixed, 0, Statistic::largest}, Quantity{"H_N_floor"},
       Quantity{two ? "H_S_floor" : "H_V_floor"}, Quantity{"overlap_max", CellStyle::scientific, 0, Statistic::largest},
       Quantity{"stable_alone", CellStyle::share, 0, Statistic::smallest}, Quantity{"z", CellStyle::fixed, 3}}};
  if (whole)
    columns.own.insert(columns.own.begin() + 1, Quantity{"phi_box"});
  return columns;
}

/// In the order of Columns::compared.
std::array<Cell, 5> paper_cells(const PaperRow& row) {
  return {count_cell(static_cast<double>(row.particles)), printed_cell(row.hellinger_number),
          printed_cell(row.hellinger_weighted), printed_cell(row.phi),
          count_cell(static_cast<double>(row.particles_in_sub_box))};
}

Group compared_group(const RunGroup& runs, const PaperTable& paper, const Columns& columns) {
  const Scene& scene = runs.job().scene;
  const Cell run_time = time_cell(group_time(runs));

  Group::Line run{"this run", {}};
  run.cells.push_back(has_equal_edges(scene) ? edge_cell(scene.size.front() * micrometres(scene.unit)) : Cell{});
  for (const Quantity& quantity : columns.compared)
    run.cells.push_back(quantity_cell(runs, quantity));
  run.cells.push_back(run_time);
  const std::string others = other_outcomes(runs);
  if (runs.ok_count() == 0)
    run.cells[1] = word_cell(others);

  Group group{runs.heading, fmt::format("n = {}", runs.ok_count()) + start_remark(runs), {run}};
  if (runs.ok_count() > 0 && !others.empty())
    group.remark += "; other runs: " + others;
  const Likeness like = likeness(scene, paper);
  const PaperRow* row = paper.find(runs.job().method);
  if (!row || like == Likeness::other_powder)
    return group;

  group.remark += protocol_remark(runs);
  const auto printed = paper_cells(*row);
  Cell paper_time = time_cell(row->time_s.value);
  paper_time.decimals = row->time_s.decimals;
  Group::Line reference{"paper", {edge_cell(paper.edge_um)}};
  Group::Line difference{"difference", {Cell{}}};
  for (std::size_t i = 0; i < printed.size(); ++i) {
    const std::string_view symbol = columns.compared[i].symbol;
    const bool comparable = like == Likeness::same || symbol == "phi_paper";
    reference.cells.push_back(printed[i]);
    difference.cells.push_back(
        comparable ? difference_cell(run.cells[i + 1], printed[i], symbol == "N_part" || symbol == "N_PB") : Cell{});
  }
  reference.cells.push_back(paper_time);
  difference.cells.push_back(like == Likeness::same ? speed_cell(time_cell(way_time(runs)), paper_time) : Cell{});
  group.lines.push_back(reference);
  if (runs.ok_count() > 0)
    group.lines.push_back(difference);
  return group;
}

Group own_group(const RunGroup& runs, const Columns& columns, DensityOracle& oracle) {
  Group::Line line;
  for (const Quantity& quantity : columns.own)
    line.cells.push_back(quantity_cell(runs, quantity));
  if (runs.job().scene.dimension == 3) {
    const auto cells = oracle_cells(runs, oracle);
    line.cells.insert(line.cells.end(), cells.begin(), cells.end());
  }
  return {runs.heading, {}, {line}};
}

} // namespace

Likeness likeness(const Scene& scene, const PaperTable& paper) {
  const double um = micrometres(scene.unit);
  const Psd& psd = scene.psd;
  const bool powder = psd.law == Law::lognormal && scene.dimension == paper.dimension &&
                      agrees(std::exp(psd.mu_ln) * um, std::exp(paper.mu_ln), kMomentTolerance) &&
                      agrees(psd.sigma_ln, paper.sigma_ln, kMomentTolerance) &&
                      agrees(psd.r_min * um, paper.r_min_um, kMomentTolerance) &&
                      agrees(psd.r_max * um, paper.r_max_um, kMomentTolerance);
  if (!powder)
    return Likeness::other_powder;
  return is_square_of(scene, paper.edge_um) && scene.count == 0 ? Likeness::same : Likeness::other_size;
}

std::vector<RunGroup> lognormal_groups(std::span<const Run> runs, const PaperTable& paper) {
  std::vector<Run> chosen;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(chosen), [&](const Run& run) {
    const Scene& scene = run.planned.job.scene;
    return scene.dimension == paper.dimension && scene.psd.law == Law::lognormal;
  });
  return group_runs(chosen);
}

Table lognormal_table(std::span<const RunGroup> groups, const PaperTable& paper) {
  const Columns columns = columns_of(paper.dimension, any_has(groups, "phi_box"));
  Panel compared{"(a) The paper's columns", {{"X", "µm", ""}}, {}};
  Panel own{"(b) What else was measured on the same packings", {}, {}};
  for (const Quantity& quantity : columns.compared)
    compared.columns.push_back(heading(quantity));
  compared.columns.push_back({"time", "", ""});
  for (const Quantity& quantity : columns.own)
    own.columns.push_back(heading(quantity));
  if (paper.dimension == 3) {
    const auto columns_of_oracle = oracle_columns();
    own.columns.insert(own.columns.end(), columns_of_oracle.begin(), columns_of_oracle.end());
  }
  DensityOracle oracle;
  for (const RunGroup& group : groups) {
    const bool ok = group.ok_count() > 0;
    if (ok || !other_outcomes(group).empty())
      compared.groups.push_back(compared_group(group, paper, columns));
    if (ok)
      own.groups.push_back(own_group(group, columns, oracle));
  }

  Table table;
  table.name = paper.name;
  table.caption = fmt::format("Lognormal powder in {}D: accuracy and cost of the generators, beside the paper's table "
                              "labelled {}.",
                              paper.dimension, paper.label);
  if (!compared.groups.empty())
    table.panels.push_back(std::move(compared));
  if (!own.groups.empty())
    table.panels.push_back(std::move(own));
  return table;
}

} // namespace tamp
