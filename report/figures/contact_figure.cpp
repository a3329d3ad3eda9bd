// Packing fraction over Coulomb's friction and the work of adhesion.
#include "report/figures/makers.h"
#include "report/figures/style.h"
#include "report/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace tamp {

namespace {

using Rows = std::vector<std::vector<double>>;

/// The one place that knows where a job keeps its material.
Material& material_of(Job& job) {
  return job.method.material;
}

Material material_of(const RunGroup& group) {
  Job job = group.job();
  return material_of(job);
}

/// All but friction and adhesion: groups alike in this are one figure.
std::string contact_family(const RunGroup& group) {
  Job job = group.job();
  job.seed = 0;
  job.replicate = 0;
  job.parent.clear();
  material_of(job).friction = 0;
  material_of(job).adhesion = 0;
  return canonical(job);
}

struct Axis {
  double Material::*field;
  const char* column;
  const char* label;
  const char* series; ///< in the legend
};
constexpr std::array kAxes = {
    Axis{&Material::friction, "mu", "friction coefficient μ", "μ = {:.4g}"},
    Axis{&Material::adhesion, "W_J_per_m2", "work of adhesion W (J/m²)", "W = {:.4g} J/m²"},
};

std::set<double> values_of(const std::vector<RunGroup>& groups, const Axis& axis) {
  std::set<double> values;
  for (const RunGroup& group : groups)
    values.insert(material_of(group).*axis.field);
  return values;
}

/// A logarithmic axis for values over decades; 0, which has no place there, stands left of the others under its name.
struct ZeroAxis {
  bool logarithmic = false;
  double place_of_zero = 0;
  std::string commands;
};

ZeroAxis zero_axis(const std::set<double>& values) {
  ZeroAxis axis;
  const auto first = values.upper_bound(0);
  const double low = first == values.end() ? 0 : *first;
  const double high = *values.rbegin();
  if (low <= 0 || high <= 10 * low) {
    const double margin = high > 0 ? 0.05 * high : 1;
    axis.commands = fmt::format("set xrange [{}:{}]\n", *values.begin() - margin, high + margin);
    return axis;
  }
  axis.logarithmic = true;
  axis.place_of_zero = low / 10;
  axis.commands = fmt::format("set logscale x\nset xrange [{}:{}]\n",
                              0.6 * (values.count(0) > 0 ? axis.place_of_zero : low), 1.6 * high);
  axis.commands += "set format x '10^{%T}'\n";
  if (values.count(0) > 0)
    axis.commands += fmt::format("set xtics ('0' {}) \nset for [i = {}:{}] xtics add (sprintf('10^{{%d}}', i) 10**i)\n",
                                 axis.place_of_zero, static_cast<int>(std::ceil(std::log10(low) - 1e-6)),
                                 static_cast<int>(std::floor(std::log10(high) + 1e-6)));
  return axis;
}

Figure contact_figure(const std::vector<RunGroup>& groups, const std::string& name) {
  const std::array<std::set<double>, 2> values = {values_of(groups, kAxes[0]), values_of(groups, kAxes[1])};
  const std::size_t across = values[1].size() > 1 ? 1 : 0; // adhesion over the axis, a line for each friction
  const Axis& axis = kAxes[across];
  const Axis& lines = kAxes[1 - across];
  const ZeroAxis scale = zero_axis(values[across]);
  Figure figure;
  figure.name = name;
  figure.width_cm = 13;
  figure.caption =
      fmt::format("Packing fraction over friction and work of adhesion: {}, {}; means and standard deviations.",
                  groups.front().label, scene_words(groups.front().job().scene));
  DataBlocks data;
  std::string plots;
  std::size_t k = 0;
  const MethodName method = groups.front().job().method.name;
  for (const double value : values[1 - across]) {
    Rows rows;
    for (const RunGroup& group : groups) {
      if (material_of(group).*lines.field != value)
        continue;
      const double x = material_of(group).*axis.field;
      const Summary phi = summarize_measure(group, "phi");
      rows.push_back({x, phi.mean, bar(phi), scale.logarithmic && x == 0 ? scale.place_of_zero : x});
    }
    std::sort(rows.begin(), rows.end());
    const std::string title = fmt::format(fmt::runtime(lines.series), value);
    const std::size_t index =
        data.add(title, std::array<std::string_view, 4>{axis.column, "phi", "sd", "drawn_at"}, rows);
    const double share = values[1 - across].size() > 1
                             ? 0.85 * static_cast<double>(k) / static_cast<double>(values[1 - across].size() - 1)
                             : 0;
    const std::string look = values[1 - across].size() > 1
                                 ? fmt::format(" lc rgb {} pt {} lw 1.5", palette_hex(share), 5 + 2 * (k % 5))
                                 : series_look(method, 0);
    plots += fmt::format("{4}'{0}.dat' index {1} using 4:2 with linespoints{2} title '{3}', \\\n"
                         "  '{0}.dat' index {1} using 4:2:3 with yerrorbars{2} notitle",
                         name, index, look, gnuplot_text(title), k == 0 ? "plot " : ", \\\n  ");
    ++k;
  }
  figure.commands =
      scale.commands + fmt::format("set xlabel '{}'\nset ylabel 'packing fraction φ'\nset key outside right top\n{}\n",
                                   axis.label, plots);
  figure.data = {{name + ".dat", data.text()}};
  return figure;
}

} // namespace

Figures contact_figures(const FigureInput& input) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<RunGroup>> families;
  for (const RunGroup& group : input.groups) {
    if (group.job().method.name != MethodName::dem_gravity || summarize_measure(group, "phi").n == 0)
      continue;
    const std::string family = contact_family(group);
    if (families.find(family) == families.end())
      order.push_back(family);
    families[family].push_back(group);
  }
  Figures out;
  for (const std::string& family : order) {
    const std::vector<RunGroup>& groups = families[family];
    if (values_of(groups, kAxes[0]).size() + values_of(groups, kAxes[1]).size() < 3)
      continue; // one contact alone
    const std::string number = out.figures.empty() ? "" : fmt::format("_{}", out.figures.size() + 1);
    out.figures.push_back(contact_figure(groups, "phi_over_contact" + number));
  }
  return out;
}

} // namespace tamp
