// Figures of boxes of many sizes: convergence with its plateau, and time with its power law and residuals.
#include "report/domain_size_table.h"
#include "report/figures/makers.h"
#include "report/figures/style.h"
#include "report/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp {

namespace {

using Rows = std::vector<std::vector<double>>;

bool counted(const RunGroup& group) {
  return group.job().scene.count > 0;
}

/// Families with ok runs at two sizes or more, all filled or all ended by a count.
std::vector<SizeFamily> families_of(const FigureInput& input, bool by_count) {
  std::vector<SizeFamily> families;
  for (SizeFamily& family : size_families(input.runs)) {
    auto& groups = family.groups;
    groups.erase(
        std::remove_if(groups.begin(), groups.end(),
                       [&](const RunGroup& group) { return group.ok_count() == 0 || counted(group) != by_count; }),
        groups.end());
    if (groups.size() > 1)
      families.push_back(std::move(family));
  }
  return families;
}

struct SizePanel {
  std::string measure;
  const char* label;
  PlateauCriterion criterion;
};

std::vector<SizePanel> panels_of(const SizeFamily& family) {
  const bool two = family.groups.front().job().scene.dimension == 2;
  return {{"phi", "packing fraction φ", kPhiCriterion},
          {"H_N", "H_N", kHellingerCriterion},
          {two ? "H_S" : "H_V", two ? "H_S" : "H_V", kHellingerCriterion}};
}

/// The dashes of what is no series.
constexpr const char* kFloorLook = "dt 3 lw 1";
constexpr const char* kPlateauLook = "dt 4 lw 1";
constexpr const char* kSizeLook = "lw 2";

/// Plateau and representative size, of families filled without a count; no lines where there are none. The upright
/// marks of the families, this one's `place` of `places`, stand above each other. Of a distance H the excess over its
/// floor converges, as in the table, whose plateau is no line in this panel.
std::string plateau_marks(const SizeFamily& family, const SizePanel& panel, std::size_t place, std::size_t places) {
  const bool distance = panel.measure != "phi";
  std::vector<SizePoint> points;
  for (const RunGroup& group : family.groups) {
    const Summary value = distance ? summarize_excess(group, panel.measure) : summarize_measure(group, panel.measure);
    if (value.n == 0)
      continue;
    if (!points.empty() && edge_of(group) <= points.back().size)
      return {};
    points.push_back({edge_of(group), value});
  }
  if (points.size() < 2)
    return {};
  const std::string colour = method_colour(family.groups.front().job().method.name);
  const Plateau plateau = find_plateau(points, panel.criterion);
  std::string marks;
  if (!distance) {
    marks = fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} nohead {2}{1}\n", plateau.value,
                        colour, kPlateauLook);
  }
  if (plateau.size) {
    marks += fmt::format("set arrow from first {0}, graph {3:.4f} to first {0}, graph {4:.4f} nohead {2}{1}\n",
                         *plateau.size, colour, kSizeLook, static_cast<double>(place) / static_cast<double>(places),
                         static_cast<double>(place + 1) / static_cast<double>(places));
  }
  return marks;
}

/// The points of one family in one panel: x, mean, sd, the floor of H.
Rows panel_rows(const SizeFamily& family, const SizePanel& panel, bool by_count) {
  Rows rows;
  for (const RunGroup& group : family.groups) {
    const Summary value = summarize_measure(group, panel.measure);
    if (value.n > 0) {
      rows.push_back({by_count ? summarize_measure(group, "N").mean : edge_of(group), value.mean, bar(value),
                      summarize_measure(group, panel.measure + "_floor").mean});
    }
  }
  return rows;
}

/// Of so many entries in two columns, in cm.
double legend_height(std::size_t entries) {
  const std::size_t rows = (entries + 1) / 2;
  return 0.4 + 0.5 * static_cast<double>(rows);
}

Figure convergence_figure(const FigureInput& input, const std::vector<SizeFamily>& families, bool by_count) {
  Figure figure;
  figure.name = by_count ? "convergence_with_count" : "convergence_with_size";
  figure.caption = fmt::format(
      "Packing fraction and Hellinger distances over the {}: means and standard deviations over replicates; dots: the "
      "sampling floor of H.{}",
      by_count ? "number of particles" : "edge of the box",
      by_count
          ? ""
          : " Level dash-dots: the plateau of φ; upright bars: the smallest box from which on every mean (of H: of "
            "its excess over the floor) lies within the tolerance of that in the largest.");
  figure.width_cm = 14;
  const Looks looks(input.runs);
  const std::string file = fmt::format("'{}.dat'", figure.name);
  DataBlocks data;
  double low = HUGE_VAL;
  double high = 0;
  std::vector<std::string> drawn;
  for (const SizePanel& panel : panels_of(families.front())) {
    std::string plots;
    std::string marks;
    for (std::size_t place = 0; place < families.size(); ++place) {
      const SizeFamily& family = families[place];
      const Rows rows = panel_rows(family, panel, by_count);
      if (rows.empty())
        continue;
      for (const auto& row : rows) {
        low = std::min(low, row[0]);
        high = std::max(high, row[0]);
      }
      const std::size_t index =
          data.add(family.name + ", " + panel.measure,
                   std::array<std::string_view, 4>{by_count ? "N" : "X_um", panel.measure, "sd", "floor"}, rows);
      const std::string look = looks.of(family.groups.front());
      plots +=
          fmt::format("{4}{0} index {1} using 1:2 with linespoints{2} title '{3}', \\\n"
                      "  {0} index {1} using 1:2:3 with yerrorbars{5} notitle",
                      file, index, look, gnuplot_text(family.name), plots.empty() ? "plot " : ", \\\n  ", solid(look));
      if (panel.measure != "phi" && !std::isnan(rows.front()[3]))
        plots += fmt::format(", \\\n  {} index {} using 1:4 with lines{} {} notitle", file, index,
                             method_colour(family.groups.front().job().method.name), kFloorLook);
      if (!by_count)
        marks += plateau_marks(family, panel, place, families.size());
    }
    if (!plots.empty() && drawn.empty()) { // the legend of all panels
      plots += fmt::format(", \\\n  keyentry with lines lc rgb '#444444' {} title 'floor of H'", kFloorLook);
      if (!by_count) {
        plots += fmt::format(", \\\n  keyentry with lines lc rgb '#444444' {} title 'plateau', \\\n  keyentry with "
                             "lines lc rgb '#444444' {} title 'size enough'",
                             kPlateauLook, kSizeLook);
      }
    }
    if (!plots.empty())
      drawn.push_back(fmt::format("{}set ylabel '{}'\n{}\nunset arrow\n", marks, panel.label, plots));
  }
  const double above = legend_height(families.size() + (by_count ? 1 : 3));
  figure.height_cm = 1.3 + above + 4.0 * static_cast<double>(drawn.size());
  figure.commands =
      fmt::format("set multiplot layout {},1 margins 0.15,0.97,{:.3f},{:.3f} spacing 0.03\n{}set xrange [{}:{}]\n"
                  "set key outside top center horizontal maxcols 2\nset format x ''\n",
                  drawn.size(), 1.3 / figure.height_cm, 1 - above / figure.height_cm,
                  high > kLogRatio * low || by_count ? "set logscale x\n" : "", 0.93 * low, 1.07 * high);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (i == 1)
      figure.commands += "unset key\n";
    if (i + 1 == drawn.size())
      figure.commands += by_count ? "set format x '10^{%T}'\nset xlabel 'particles N'\n"
                                  : "set format x '%g'\nset xlabel 'edge X of the box (µm)'\n";
    figure.commands += drawn[i];
  }
  figure.commands += "unset multiplot\n";
  figure.data = {{figure.name + ".dat", data.text()}};
  return figure;
}

} // namespace

Figures convergence_figures(const FigureInput& input) {
  Figures out;
  for (const bool by_count : {false, true}) {
    std::vector<SizeFamily> families = families_of(input, by_count);
    families.erase(std::remove_if(families.begin(), families.end(),
                                  [&](const SizeFamily& family) {
                                    const auto panels = panels_of(family);
                                    return std::all_of(panels.begin(), panels.end(), [&](const SizePanel& panel) {
                                      return panel_rows(family, panel, by_count).empty();
                                    });
                                  }),
                   families.end());
    if (!families.empty())
      out.figures.push_back(convergence_figure(input, families, by_count));
  }
  return out;
}

namespace {

/// ": β = 1.04 [1.00, 1.09]"; empty where there is no line.
std::string exponent_words(const PowerLaw& law) {
  if (std::isnan(law.beta))
    return {};
  if (std::isnan(law.beta_low))
    return fmt::format(": β = {:.2f}", law.beta);
  return fmt::format(": β = {:.2f} [{:.2f}, {:.2f}]{}", law.beta, law.beta_low, law.beta_high,
                     law.warnings.empty() ? "" : ", doubtful");
}

} // namespace

Figures scaling_figures(const FigureInput& input) {
  Figure figure;
  figure.name = "time_over_count";
  figure.width_cm = 14;
  figure.caption = "Time of the generators over the number of particles: geometric means over replicates, power laws "
                   "t = a N^β by least squares of the logarithms, β with its 95 % interval, and below what is left of "
                   "the times when "
                   "divided by the fit.";
  std::string doubtful;
  std::size_t entries = 0;
  const Looks looks(input.runs);
  DataBlocks data;
  std::string times;
  std::string residuals;
  const std::string file = fmt::format("'{}.dat'", figure.name);
  bool shared = false;
  for (const bool by_count : {false, true}) {
    for (const SizeFamily& family : families_of(input, by_count)) {
      const TimedPoints timed = timed_points(family);
      if (timed.points.size() < 2)
        continue;
      shared = shared || timed.mode == TimingMode::shared;
      const PowerLaw law = fit_power_law(timed.points);
      Rows rows;
      for (std::size_t i = 0; i < timed.points.size(); ++i)
        rows.push_back(
            {timed.points[i].n, timed.points[i].t, law.residuals.empty() ? std::nan("") : std::exp(law.residuals[i])});
      const std::size_t index =
          data.add(family.name, std::array<std::string_view, 3>{"N", "seconds", "seconds_over_fit"}, rows);
      const std::string look = looks.of(family.groups.front());
      const std::string name = gnuplot_text(family.name);
      const std::string fit = exponent_words(law);
      if (!law.warnings.empty())
        doubtful += fmt::format("{}{}: {}", doubtful.empty() ? "" : "; ", family.name, fmt::join(law.warnings, ", "));
      ++entries;
      times += fmt::format("{}{} index {} using 1:2 with points{} title '{}{}'", times.empty() ? "plot " : ", \\\n  ",
                           file, index, look, name, fit);
      if (std::isnan(law.beta))
        continue;
      const Rows line = {{law.n_low, law.time(law.n_low)}, {law.n_high, law.time(law.n_high)}};
      const std::size_t drawn =
          data.add(family.name + ", power law", std::array<std::string_view, 2>{"N", "seconds"}, line);
      times += fmt::format(", \\\n  {} index {} using 1:2 with lines{} lw 1.2 notitle", file, drawn,
                           method_colour(family.groups.front().job().method.name));
      residuals +=
          fmt::format("{}{} index {} using 1:3 with linespoints{} notitle",
                      residuals.empty() ? "plot 1 with lines lc rgb '#444444' lw 1 notitle, \\\n  " : ", \\\n  ", file,
                      index, look);
    }
  }
  if (times.empty())
    return {};
  if (!doubtful.empty())
    figure.caption += fmt::format(" Doubtful: {}.", doubtful);
  if (shared)
    figure.caption += " Some times were taken beside other jobs and say little.";
  // One column: names are long. The plots keep their heights, in cm; the legend comes on top of them.
  constexpr double kResidualLow = 1.3;
  constexpr double kResidualHigh = 4.3;
  constexpr double kTimesLow = 4.9;
  constexpr double kTimesHigh = 11.6;
  figure.height_cm = kTimesHigh + legend_height(2 * entries);
  const auto at = [&](double cm) { return fmt::format("screen {:.4f}", cm / figure.height_cm); };
  figure.commands =
      fmt::format("set logscale xy\nset format y '10^{{%T}}'\nset format x ''\nset lmargin at screen 0.13\n"
                  "set rmargin at screen 0.97\nset multiplot\nset tmargin at {}\nset bmargin at {}\n"
                  "set key at screen 0.13, screen 0.995 left top maxcols 1\nset ylabel 'time (s)'\n{}\n"
                  "unset logscale y\nset format y '%g'\nset tmargin at {}\nset bmargin at {}\nset key off\n"
                  "set format x '10^{{%T}}'\nset xlabel 'particles N'\nset ylabel 't / fit'\n{}unset multiplot\n",
                  at(kTimesHigh), at(kTimesLow), times, at(kResidualHigh), at(kResidualLow),
                  residuals.empty() ? "" : residuals + "\n");
  figure.data = {{figure.name + ".dat", data.text()}};
  return {{figure}, {}};
}

} // namespace tamp
