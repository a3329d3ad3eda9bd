// Makes the tables of the Furnas plane: one quantity over X_L and the size ratio.
#include "report/bimodal_tables.h"
#include "report/cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace tamp {

namespace {

struct Shown {
  Quantity quantity;
  const char* title;
};
constexpr std::array kShown = {Shown{Quantity{"phi"}, "packing fraction ⟨phi⟩"},
                               Shown{Quantity{"phi_box"}, "packing fraction ⟨phi_box⟩ of the whole periodic box"},
                               Shown{Quantity{"phi_paper"}, "packing fraction ⟨phi_paper⟩ by the paper's estimator"},
                               Shown{Quantity{"X_L"}, "share ⟨X_L⟩ of the large spheres as reached"}};

/// A place in the plane: X_L, size ratio.
using Place = std::pair<double, double>;

Panel plane(const std::string& label, const Shown& shown, const std::map<Place, const RunGroup*>& places) {
  std::set<double> fractions;
  std::set<double> ratios;
  for (const auto& [place, group] : places) {
    fractions.insert(place.first);
    ratios.insert(place.second);
  }
  Panel panel{fmt::format("{}: {}", label, shown.title), {}, {}};
  for (const double ratio : ratios)
    panel.columns.push_back({std::string(shown.quantity.symbol), "1", fmt::format("at ⟨rho⟩ = {}", ratio)});
  for (const double fraction : fractions) {
    Group::Line line;
    for (const double ratio : ratios) {
      Cell cell;
      if (const auto found = places.find({fraction, ratio}); found != places.end()) {
        cell = quantity_cell(*found->second, shown.quantity);
        if (found->second->ok_count() == 0)
          cell = word_cell(other_outcomes(*found->second));
      }
      cell.quantity = fmt::format("{} at rho = {}", shown.quantity.symbol, ratio);
      line.cells.push_back(cell);
    }
    panel.groups.push_back({fmt::format("{}, ⟨X_L⟩ = {}", label, fraction), {}, {line}});
  }
  return panel;
}

std::vector<Note> own_notes() {
  return {{"Lines and columns",
           "Down: the fraction ⟨X_L⟩ of the large spheres in the volume of all, as the law states it. Across: the size "
           "ratio. Mean ± sample standard deviation over replicates. ⟨X_L⟩ = 0 and ⟨X_L⟩ = 1 are equal spheres, and so "
           "is size ratio 1, where all spheres count as large."},
          {"Box",
           "Equal large spheres fill a box of a few of their radii only, so that the walls lower ⟨phi⟩ and raise "
           "its spread at ⟨X_L⟩ near 1; \"What was run\" has the edges."}};
}

} // namespace

Table furnas_table(std::span<const RunGroup> groups) {
  std::vector<std::string> labels;
  std::map<std::string, std::map<Place, const RunGroup*>> planes;
  std::size_t hidden = 0;
  for (const RunGroup& group : groups) {
    if (group.ok_count() == 0 && other_outcomes(group).empty())
      continue;
    if (planes.find(group.label) == planes.end())
      labels.push_back(group.label);
    const Psd& psd = group.job().scene.psd;
    if (!planes[group.label].emplace(Place{psd.large_volume_fraction, psd.size_ratio}, &group).second)
      ++hidden;
  }
  Table table;
  table.name = "furnas";
  table.caption = "Binary mixtures in the Furnas plane: packing fraction and composition over the share of the large "
                  "spheres and the size ratio.";
  for (const std::string& label : labels) {
    const bool whole = std::any_of(planes[label].begin(), planes[label].end(),
                                   [](const auto& place) { return summarize_measure(*place.second, "phi_box").n > 0; });
    for (const Shown& shown : kShown) {
      if (whole || shown.quantity.symbol != "phi_box")
        table.panels.push_back(plane(label, shown, planes[label]));
    }
  }
  if (!labels.empty())
    table.notes = own_notes();
  if (hidden > 0) {
    table.notes.push_back(
        {"Left out", fmt::format("{} groups that share method, fraction and size ratio with one shown: "
                                 "state a label of its own for each.",
                                 hidden)});
  }
  return table;
}

} // namespace tamp
