// Accuracy against time: how far from the expected density, and from the law, what each second buys.
#include "report/cells.h"
#include "report/density_oracle.h"
#include "report/figures/makers.h"
#include "report/figures/style.h"
#include "report/lognormal_table.h"
#include "report/paper_tables.h"
#include "report/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace tamp {

namespace {

using Rows = std::vector<std::vector<double>>;

/// The volume-weighted distance to the law over its sampling floor.
Summary infidelity(const RunGroup& group) {
  const std::string measure = group.job().scene.dimension == 2 ? "H_S" : "H_V";
  std::vector<double> values;
  for (const Run& run : group.runs) {
    const auto distance = run.ok() ? run.measure(measure) : std::nullopt;
    const auto floor = run.measure(measure + "_floor");
    if (distance && floor && *floor > 0)
      values.push_back(*distance / *floor);
  }
  return summarize(values);
}

/// Smallest and largest time.
using Range = std::pair<double, double>;

void widen(Range& range, double seconds) {
  range = {std::min(range.first, seconds), std::max(range.second, seconds)};
}

std::string paper_points(const FigureInput& input, std::int64_t dimension, DataBlocks& data, const std::string& file,
                         DensityOracle& oracle, Range& range) {
  std::map<std::string, Rows> rows; // by tool
  for (const PaperTable& paper : paper_tables()) {
    const std::vector<RunGroup> groups = lognormal_groups(input.runs, paper);
    const auto alike = std::find_if(groups.begin(), groups.end(), [&](const RunGroup& group) {
      return group.job().scene.dimension == dimension && group.ok_count() > 0 &&
             likeness(group.job().scene, paper) == Likeness::same;
    });
    if (alike == groups.end())
      continue;
    const double expected = oracle(alike->job().scene);
    for (const PaperRow& row : paper.rows) {
      rows[std::string(row.method)].push_back({row.time_s.value, row.phi.value - expected});
      widen(range, row.time_s.value);
    }
  }
  std::string plots;
  for (const auto& [tool, points] : rows) {
    const std::size_t index =
        data.add("paper, " + tool, std::array<std::string_view, 2>{"seconds", "phi_minus_oracle"}, points);
    plots += fmt::format(", \\\n  {} index {} using 1:2 with points{} title '{}'", file, index, paper_look(tool),
                         gnuplot_text("paper: " + tool));
  }
  return plots;
}

/// The plot's left and right edge; right of it the legend, whose marks take `kLegend` and each letter `kLetter`: cm.
constexpr double kPlotStart = 2.2;
constexpr double kPlotEnd = 10.6;
constexpr double kLegend = 1.6;
constexpr double kLetter = 0.19;

/// Letters of the longest name in the legend.
std::size_t longest_name(const std::vector<std::string>& labels, bool with_paper) {
  constexpr std::size_t kLongestOfPaper = 21; // "paper: LAMMPS_Lee2018"
  std::size_t longest = with_paper ? kLongestOfPaper : 0;
  for (const std::string& label : labels)
    longest = std::max(longest, label.size());
  return longest;
}

/// What sets a scene apart from the others of its figure, where something does: its size ratio, its edge.
class SceneTags {
public:
  explicit SceneTags(const std::vector<const RunGroup*>& groups) {
    for (const RunGroup* group : groups) {
      const Scene& scene = group->job().scene;
      ratios_.insert(scene.psd.size_ratio);
      fractions_.insert(scene.psd.large_volume_fraction);
      edges_.insert(scene.size.front());
    }
  }

  [[nodiscard]] std::string of(const Scene& scene) const {
    std::string words;
    const auto add = [&](const std::string& word) { words += (words.empty() ? "" : ", ") + word; };
    if (ratios_.size() > 1)
      add(fmt::format("ρ {:.4g}", scene.psd.size_ratio));
    if (fractions_.size() > 1)
      add(fmt::format("X_L {:.3g}", scene.psd.large_volume_fraction));
    if (edges_.size() > 1)
      add(fmt::format("{:.4g} µm", scene.size.front() * micrometres(scene.unit)));
    return words;
  }

private:
  std::set<double> ratios_, fractions_, edges_;
};

/// A word beside a point, small and grey.
std::string beside_point(double x, double y, const std::string& word) {
  return fmt::format("set label '{{/*0.7 {}}}' at {}, {} left offset 0.6,0.35 textcolor rgb '#666666'\n",
                     gnuplot_text(word), x, y);
}

std::vector<const RunGroup*> timed_groups(const FigureInput& input, std::int64_t dimension) {
  std::vector<const RunGroup*> groups;
  for (const RunGroup& group : input.groups) {
    if (group.job().scene.dimension == dimension && group_time(group).seconds.median > 0 &&
        summarize_measure(group, "phi").n + infidelity(group).n > 0)
      groups.push_back(&group);
  }
  return groups;
}

/// Nothing where there is nothing to choose between.
std::optional<Figure> cost_figure(const FigureInput& input, std::int64_t dimension, const std::string& name) {
  const std::vector<const RunGroup*> groups = timed_groups(input, dimension);
  const SceneTags tags(groups);
  std::vector<std::string> labels;
  std::map<std::string, Rows> rows;
  std::map<std::string, std::string> look;
  const Looks looks(input.runs);
  DensityOracle oracle;
  bool any_phi = false;
  bool any_law = false;
  bool shared = false;
  std::string phi_tags;
  std::string law_tags;
  Range range{HUGE_VAL, 0};
  for (const RunGroup* group : groups) {
    const Summary phi = summarize_measure(*group, "phi");
    const Summary law = infidelity(*group);
    const double seconds = group_time(*group).seconds.median;
    const double above = phi.mean - oracle(group->job().scene);
    any_phi = any_phi || phi.n > 0;
    any_law = any_law || law.n > 0;
    shared = shared || group_time(*group).mode == TimingMode::shared;
    if (rows.find(group->label) == rows.end())
      labels.push_back(group->label);
    look[group->label] = looks.of(*group);
    widen(range, seconds);
    rows[group->label].push_back({seconds, above, bar(phi), law.mean, bar(law)});
    const std::string tag = tags.of(group->job().scene);
    if (!tag.empty() && phi.n > 0)
      phi_tags += beside_point(seconds, above, tag);
    if (!tag.empty() && law.n > 0)
      law_tags += beside_point(seconds, law.mean, tag);
  }
  if (labels.size() < 2)
    return std::nullopt;
  Figure figure;
  figure.name = name;
  figure.caption =
      fmt::format("What accuracy costs, one point for each method and scene over its median time: distance "
                  "of φ to the density expected of the powder ({})",
                  dimension == 2 ? "2D: 0.84" : "Farr and Groot");
  DataBlocks data;
  const std::string file = fmt::format("'{}.dat'", name);
  std::string phi_plots;
  std::string law_plots;
  for (const std::string& label : labels) {
    const std::size_t index = data.add(
        label, std::array<std::string_view, 5>{"seconds", "phi_minus_oracle", "sd", "H_over_floor", "sd"}, rows[label]);
    const auto add = [&](std::string& plots, int column, const std::string& title) {
      plots += fmt::format("{5}{0} index {1} using 1:{2} with points{3} {4}, \\\n"
                           "  {0} index {1} using 1:{2}:{6} with yerrorbars{7} notitle",
                           file, index, column, look[label], title, plots.empty() ? "plot " : ", \\\n  ", column + 1,
                           solid(look[label]));
    };
    add(phi_plots, 2, fmt::format("title '{}'", gnuplot_text(label)));
    add(law_plots, 4, any_phi ? "notitle" : fmt::format("title '{}'", gnuplot_text(label)));
  }
  const std::string paper = any_phi ? paper_points(input, dimension, data, file, oracle, range) : "";
  figure.width_cm = kPlotEnd + kLegend + kLetter * static_cast<double>(longest_name(labels, !paper.empty()));
  figure.height_cm = 8;
  const double left = kPlotStart / figure.width_cm;
  const double right = kPlotEnd / figure.width_cm;
  figure.commands =
      fmt::format("set logscale x\nset format x '10^{{%T}}'\nset xlabel 'median time (s)'\nset xrange [{}:{}]\n"
                  "set offsets graph 0, graph 0, graph 0.05, graph 0.05\nset lmargin at screen {:.4f}\n"
                  "set rmargin at screen {:.4f}\nset key at screen {:.4f}, screen 0.96 left top\n",
                  0.5 * range.first, 2 * range.second, left, right, right + 0.02);
  if (any_phi && any_law) {
    figure.height_cm = 13;
    figure.commands +=
        fmt::format("set multiplot layout 2,1 margins {:.4f},{:.4f},0.1,0.97 spacing 0.03\n", left, right);
  }
  if (any_phi) {
    if (!paper.empty())
      figure.caption += ", the paper's points by its own, lower, estimator in grey";
    if (any_law)
      figure.commands += "set format x ''\nunset xlabel\n";
    figure.commands += phi_tags + "set ylabel 'φ − φ expected'\n" + phi_plots + paper +
                       ", \\\n  0 with lines lc rgb '#444444' lw 1 notitle\nunset label\n";
  }
  if (any_law) {
    figure.caption += fmt::format("{}Hellinger distance by {} over the floor of random sampling",
                                  any_phi ? ", and " : ": ", dimension == 2 ? "surface" : "volume");
    figure.commands +=
        fmt::format("{}set format x '10^{{%T}}'\nset xlabel 'median time (s)'\nset ylabel '{} / floor'\n", law_tags,
                    dimension == 2 ? "H_S" : "H_V") +
        law_plots + ", \\\n  1 with lines lc rgb '#444444' lw 1 notitle\n";
  }
  figure.caption += shared ? ". Some times were taken beside other jobs and say little." : ".";
  if (any_phi && any_law)
    figure.commands += "unset multiplot\n";
  figure.data = {{figure.name + ".dat", data.text()}};
  return figure;
}

} // namespace

Figures cost_figures(const FigureInput& input) {
  const std::string name = "accuracy_against_time";
  const bool both = !timed_groups(input, 2).empty() && !timed_groups(input, 3).empty();
  Figures out;
  for (const std::int64_t dimension : {2, 3}) {
    if (auto figure = cost_figure(input, dimension, both ? fmt::format("{}_{}d", name, dimension) : name))
      out.figures.push_back(std::move(*figure));
  }
  return out;
}

} // namespace tamp
