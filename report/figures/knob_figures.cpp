// What accuracy costs: the error of the packing fraction over the time of every setting, and over every knob.
#include "report/accuracy_table.h"
#include "report/figures/makers.h"
#include "report/figures/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace tamp {

namespace {

using Rows = std::vector<std::vector<double>>;

constexpr double kPercent = 100;

/// Points of every method, and the line of those that no other setting of any method beats.
Figure front_figure(const std::vector<Setting>& settings, const Looks& looks) {
  Figure figure;
  figure.name = "accuracy_front";
  figure.caption =
      "What accuracy costs: a point for each setting of each knob, its bound of the error of φ (95 %, scatter "
      "of the replicates included) over the median time from the scene on; large: the defaults; line: what no "
      "other setting beats. Each method's error is that from its own limit.";
  figure.width_cm = 14;
  figure.height_cm = 9;
  std::vector<std::string> labels;
  std::map<std::string, Rows> rows;
  std::map<std::string, Rows> defaults;
  std::map<std::string, const RunGroup*> any;
  for (const Setting& setting : settings) {
    const std::string& label = setting.family->label;
    const KnobLevel& level = setting.family->levels[setting.level];
    if (any.emplace(label, &level.group).second)
      labels.push_back(label);
    const std::vector<double> row = {setting.seconds, kPercent * setting.error, level.value};
    rows[label].push_back(row);
    if (level.is_default)
      defaults[label].push_back(row);
  }
  constexpr std::array<std::string_view, 3> kColumns = {"seconds", "error_percent", "knob"};
  DataBlocks data;
  const std::string file = fmt::format("'{}.dat'", figure.name);
  std::string plots;
  const auto add = [&](std::size_t index, const std::string& how, const std::string& title) {
    plots += fmt::format("{}{} index {} using 1:2 with {} title '{}'", plots.empty() ? "plot " : ", \\\n  ", file,
                         index, how, gnuplot_text(title));
  };
  Rows front;
  for (const Setting& setting : front_of(settings))
    front.push_back({setting.seconds, kPercent * setting.error, setting.family->levels[setting.level].value});
  const std::size_t line = data.add("front", kColumns, front);
  add(line, "steps lc rgb '#999999' lw 2", "front");
  for (const std::string& label : labels) {
    const std::string look = solid(looks.of(*any[label]));
    add(data.add(label, kColumns, rows[label]), "points" + look + " ps 0.7", label);
    if (!defaults[label].empty())
      add(data.add(label + ", default", kColumns, defaults[label]), "points" + look + " ps 1.6", "");
  }
  figure.commands = "set logscale xy\nset format x '10^{%T}'\nset format y '%g'\nset xlabel 'median time (s)'\n"
                    "set ylabel 'error of φ at most (%)'\nset key outside right top\nset grid\n" +
                    plots + "\n";
  figure.data = {{figure.name + ".dat", data.text()}};
  return figure;
}

/// One small plot for each knob: the error with its interval, and the law of the order where there is one.
Figure knobs_figure(const std::vector<KnobFamily>& families, const Looks& looks) {
  Figure figure;
  figure.name = "accuracy_knobs";
  figure.caption =
      "Distance of φ from its limit, or from the finest level where no order shows, over each knob, with 95 % "
      "intervals; lines: fitted orders of convergence.";
  DataBlocks data;
  const std::string file = fmt::format("'{}.dat'", figure.name);
  std::string plots;
  std::size_t count = 0;
  for (const KnobFamily& family : families) {
    const auto effect = knob_effect(family, "phi");
    if (!effect)
      continue;
    Rows rows;
    for (std::size_t i = 0; i < family.levels.size(); ++i) {
      const double share = kPercent / effect->reference;
      rows.push_back({family.levels[i].value, share * effect->error[i].value, share * effect->error[i].half_width});
    }
    const std::string path(family.knob->path.substr(family.knob->path.find('/') + 1));
    const std::size_t index = data.add(family.label + ": " + path,
                                       std::array<std::string_view, 3>{"knob", "error_percent", "half_width"}, rows);
    const std::string look = solid(looks.of(family.levels.front().group));
    plots += fmt::format("set title '{}'\nset xlabel '{}'\nplot 0 with lines lc rgb '#444444' lw 1 notitle, \\\n"
                         "  {} index {} using 1:2:3 with yerrorbars{} notitle",
                         gnuplot_text(family.label), gnuplot_text(path), file, index, look);
    if (effect->order.found()) {
      const std::string step = family.knob->finer == Finer::smaller ? "x" : "(1.0/x)";
      plots += fmt::format(", \\\n  {:.17g}*{}**{:.17g} with lines lc rgb '#444444' dt 2 notitle",
                           kPercent * effect->order.factor / effect->reference, step, effect->order.order);
    }
    plots += "\n";
    ++count;
  }
  constexpr std::size_t kAcross = 3;
  const std::size_t down = (count + kAcross - 1) / kAcross;
  figure.width_cm = 17;
  figure.height_cm = 5.2 * static_cast<double>(down);
  figure.commands =
      fmt::format("set multiplot layout {},{}\nset logscale x\nset format x '10^{{%T}}'\nset ylabel 'error of φ (%)'\n"
                  "unset key\n{}unset multiplot\n",
                  down, kAcross, plots);
  figure.data = {{figure.name + ".dat", data.text()}};
  return figure;
}

} // namespace

Figures knob_figures(const FigureInput& input) {
  Figures out;
  const std::vector<KnobFamily> families = knob_families(input.runs);
  const std::vector<Setting> settings = settings_of(families);
  const bool any_turned = std::any_of(families.begin(), families.end(), [](const KnobFamily& family) {
    return family.knob->path != "scene/count"; // boxes of many sizes have figures of their own
  });
  if (settings.empty() || !any_turned)
    return out;
  const Looks looks(input.runs);
  out.figures.push_back(front_figure(settings, looks));
  out.figures.push_back(knobs_figure(families, looks));
  return out;
}

} // namespace tamp
