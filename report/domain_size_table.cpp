// Makes the table of boxes of many sizes.
#include "report/domain_size_table.h"

#include "report/cells.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace tamp {

namespace {

constexpr std::array kShown = {Quantity{"N_part", CellStyle::fixed, 0}, Quantity{"phi_paper"}, Quantity{"phi"},
                               Quantity{"phi_box"}};

std::array<Quantity, 4> distances(int dimension) {
  const bool two = dimension == 2;
  return {Quantity{"H_N"}, Quantity{"H_N_floor"}, Quantity{two ? "H_S" : "H_V"},
          Quantity{two ? "H_S_floor" : "H_V_floor"}};
}

Cell number_cell(double value, int decimals) {
  Cell cell;
  cell.value = value;
  cell.decimals = decimals;
  return cell;
}

Cell three_digits(double value) {
  Cell cell;
  cell.value = value;
  return cell;
}

std::string size_name(const SizeFamily& family, const RunGroup& group) {
  const Scene& scene = group.job().scene;
  if (scene.count > 0)
    return fmt::format("{}, ⟨N_part⟩ = {}", family.name, scene.count);
  return fmt::format("{}, ⟨X⟩ = {} µm", family.name, edge_of(group));
}

Group size_group(const SizeFamily& family, const RunGroup& runs, std::optional<std::size_t> point,
                 const PowerLaw& law) {
  Group::Line line{"", {edge_cell(edge_of(runs)), count_cell(static_cast<double>(runs.ok_count()))}};
  if (runs.ok_count() == 0) {
    line.cells.push_back(word_cell(other_outcomes(runs)));
    line.cells.resize(kShown.size() + 4);
    return {size_name(family, runs), {}, {line}};
  }
  for (const Quantity& quantity : kShown)
    line.cells.push_back(quantity_cell(runs, quantity));
  line.cells.push_back(time_cell(group_time(runs)));
  // Only a time of the mode that was fitted stands against the fit.
  line.cells.push_back(point && !law.residuals.empty() ? number_cell(std::exp(law.residuals[*point]), 2) : Cell{});
  return {size_name(family, runs), {}, {line}};
}

Group distance_group(const SizeFamily& family, const RunGroup& runs, std::span<const Quantity> quantities) {
  Group::Line line;
  for (const Quantity& quantity : quantities)
    line.cells.push_back(quantity_cell(runs, quantity));
  return {size_name(family, runs), {}, {line}};
}

Group fit_group(const SizeFamily& family, const PowerLaw& law) {
  Cell coefficient;
  coefficient.value = law.a;
  coefficient.style = CellStyle::scientific;
  coefficient.unit = "s";
  return {family.name,
          {},
          {{"",
            {count_cell(static_cast<double>(law.points)), number_cell(law.n_low, 0), number_cell(law.n_high, 0),
             number_cell(law.beta, 3), number_cell(law.beta_low, 3), number_cell(law.beta_high, 3), coefficient,
             number_cell(law.r_squared, 5), number_cell(law.curvature_p, 3)}}}};
}

const std::vector<Column> kFitColumns = {{"points", "1", ""}, {"N_min", "1", ""},     {"N_max", "1", ""},
                                         {"beta", "1", ""},   {"beta_low", "1", ""},  {"beta_high", "1", ""},
                                         {"a", "s", ""},      {"R_squared", "1", ""}, {"p_curved", "1", ""}};

struct Converging {
  std::string symbol;
  PlateauCriterion criterion;
  bool excess = false; ///< of a Hellinger distance over its floor, which falls with N and so is no convergence

  [[nodiscard]] Summary of(const RunGroup& group) const {
    return excess ? summarize_excess(group, symbol) : summarize_measure(group, symbol);
  }
  [[nodiscard]] std::string name() const {
    return excess ? fmt::format("⟨{0}⟩ − ⟨{0}_floor⟩", symbol) : fmt::format("⟨{}⟩", symbol);
  }
};

/// Rows of the panel of convergence, and a sentence for each quantity that has no plateau.
void add_plateaus(const SizeFamily& family, Panel& panel, std::string& reasons) {
  const bool two = family.groups.front().job().scene.dimension == 2;
  const std::array<Converging, 4> quantities = {
      Converging{"phi_paper", kPhiCriterion}, Converging{"phi", kPhiCriterion},
      Converging{"H_N", kHellingerCriterion, true}, Converging{two ? "H_S" : "H_V", kHellingerCriterion, true}};
  for (const Converging& quantity : quantities) {
    std::vector<SizePoint> points;
    bool increasing = true;
    for (const RunGroup& group : family.groups) {
      const Summary summary = quantity.of(group);
      if (summary.n == 0)
        continue;
      increasing = increasing && (points.empty() || points.back().size < edge_of(group));
      points.push_back({edge_of(group), summary});
    }
    if (points.empty())
      continue;
    if (!increasing) {
      reasons += fmt::format(" {}, {}: several groups share one size.", family.name, quantity.name());
      continue;
    }
    const Plateau found = find_plateau(points, quantity.criterion);
    panel.groups.push_back(
        {fmt::format("{}: {}", family.name, quantity.name()),
         {},
         {{"",
           {number_cell(found.value, 4), three_digits(quantity.criterion.tolerance),
            three_digits(quantity.criterion.spread), found.size ? edge_cell(*found.size) : word_cell("none")}}}});
    if (!found.size)
      reasons += fmt::format(" {}, {}: {}.", family.name, quantity.name(), found.why_none);
  }
}

Note columns_note() {
  return {"Columns",
          "Mean ± sample standard deviation over the n replicates that ended ok. ⟨X⟩: edge of the box. "
          "⟨N_part⟩: particles. ⟨phi_paper⟩: the paper's estimator, ⟨phi⟩: the exact packing fraction, both "
          "in the central sub-box; ⟨phi_box⟩: the exact one of the whole box, where it is periodic on all sides. "
          "⟨H_N⟩, ⟨H_V⟩ (⟨H_S⟩ in 2D): Hellinger distance of the radii to the law, by "
          "number and by volume (surface), with the floor that perfect random sampling of as many particles "
          "has. Where the box is smaller than the law's largest sphere, the law is cut (r_max in \"What was "
          "run\") and ⟨H⟩ is the distance to the cut law. ⟨t_over_fit⟩: geometric mean of the times divided by that of "
          "the fit."};
}

Note fit_note() {
  return {
      "Fit",
      fmt::format("t = a ⟨N_part⟩^⟨beta⟩ by least squares of ln t on ln N through one point for each size (geometric "
                  "means over replicates), with the {:.0f} % confidence interval of ⟨beta⟩ by Student's t; "
                  "⟨R_squared⟩ is that of ln t; ⟨p_curved⟩ is the probability that a straight line would show so "
                  "much curvature, by the t test of a quadratic term.",
                  100 * (1 - kSignificance))};
}

Note convergence_note(const std::string& reasons) {
  std::string text =
      "The plateau is the mean in the largest box; ⟨X_RVE⟩ is the smallest box from which on every mean "
      "lies within the tolerance of it and the standard deviation over replicates is under its bound. "
      "The largest box alone proves nothing. Of a distance ⟨H⟩ the excess over its floor is judged: the floor falls "
      "with the number of particles in any box, and ⟨H⟩ with it.";
  if (!reasons.empty())
    text += " No such box:" + reasons;
  return {"Convergence", text};
}

/// Where one family's times are of both modes, and where the points do not support a power law.
std::string remarks_on(const SizeFamily& family, const TimedPoints& timed, const PowerLaw& law) {
  std::string text;
  if (timed.left_out > 0)
    text += fmt::format(" {}: {} runs in the other timing mode are left out of the fit.", family.name, timed.left_out);
  if (timed.disturbed > 0)
    text += fmt::format(" {}: {} disturbed times are left out of the fit.", family.name, timed.disturbed);
  if (timed.processors.size() > 1)
    text += fmt::format(" {}: the fit joins times of different processors, {}, and so is no law of any of them.",
                        family.name, fmt::join(timed.processors, " and "));
  if (!law.warnings.empty())
    text += fmt::format(" {}: {}.", family.name, fmt::join(law.warnings, "; "));
  return text;
}

} // namespace

Table domain_size_table(std::span<const SizeFamily> families) {
  Table table;
  table.name = "domain_size";
  table.caption = "Boxes of many sizes: particles, packing fraction, Hellinger distance and time; scaling of the time "
                  "with the number of particles; size of a representative volume.";
  if (families.empty())
    return table;
  const auto quantities = distances(static_cast<int>(families.front().groups.front().job().scene.dimension));
  Panel sizes{"By size", {{"X", "µm", ""}, {"n", "1", ""}}, {}};
  for (const Quantity& quantity : kShown)
    sizes.columns.push_back(heading(quantity));
  sizes.columns.push_back({"time", "", ""});
  sizes.columns.push_back({"t_over_fit", "1", ""});
  Panel radii{"Distance of the radii to the law", {}, {}};
  for (const Quantity& quantity : quantities)
    radii.columns.push_back(heading(quantity));
  Panel fits{"Scaling of the time", kFitColumns, {}};
  Panel plateaus{"Convergence with the size of the box",
                 {{"plateau", "1", ""}, {"tolerance", "1", ""}, {"spread", "1", ""}, {"X_RVE", "µm", ""}},
                 {}};
  std::string remarks;
  std::string reasons;
  for (const SizeFamily& family : families) {
    const TimedPoints timed = timed_points(family);
    const PowerLaw law = fit_power_law(timed.points);
    for (std::size_t i = 0; i < family.groups.size(); ++i) {
      const RunGroup& group = family.groups[i];
      if (group.ok_count() > 0 || !other_outcomes(group).empty())
        sizes.groups.push_back(size_group(family, group, timed.of_group[i], law));
      if (group.ok_count() > 0)
        radii.groups.push_back(distance_group(family, group, quantities));
    }
    if (!timed.points.empty()) {
      fits.groups.push_back(fit_group(family, law));
      remarks += remarks_on(family, timed, law);
    }
    const bool filled = std::all_of(family.groups.begin(), family.groups.end(),
                                    [](const RunGroup& group) { return group.job().scene.count == 0; });
    if (filled)
      add_plateaus(family, plateaus, reasons);
  }
  for (Panel* panel : {&sizes, &radii, &fits, &plateaus}) {
    drop_empty_columns(*panel);
    if (panel->groups.empty() || panel->columns.empty())
      continue;
    panel->title = fmt::format("({}) {}", static_cast<char>('a' + table.panels.size()), panel->title);
    table.panels.push_back(*panel);
  }
  if (table.panels.empty())
    return table;
  table.notes = {columns_note(), fit_note()};
  if (!remarks.empty())
    table.notes.push_back({"Doubts about the fit", remarks.substr(1)});
  if (!plateaus.groups.empty())
    table.notes.push_back(convergence_note(reasons));
  return table;
}

} // namespace tamp
