// Figures of binary mixtures: packing fraction over the size ratio, and in the Furnas plane.
#include "engine/model/random_close_packing.h"
#include "report/bimodal_tables.h"
#include "report/figures/makers.h"
#include "report/figures/style.h"
#include "report/paper_bimodal.h"
#include "report/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace tamp {

namespace {

using Rows = std::vector<std::vector<double>>;

constexpr int kCurvePoints = 25; // the estimate takes milliseconds

/// Farr and Groot's estimate for spheres of two sizes.
double oracle(double size_ratio, double large_fraction) {
  Psd psd;
  psd.law = Law::bimodal;
  psd.small_radius = 1;
  psd.size_ratio = size_ratio;
  psd.large_volume_fraction = large_fraction;
  return random_close_packing(SizeLaw(psd, 3), 3);
}

/// C. C. Furnas, Ind. Eng. Chem. 23, 1052 (1931): infinitely different sizes, each packed with phi_0. Either the large
/// spheres touch and the small ones fill their voids, or large ones swim in the packing of the small ones.
double furnas_limit(double phi_0, double large_fraction) {
  const double in_small = phi_0 / (1 - large_fraction * (1 - phi_0));
  return large_fraction > 0 ? std::min(phi_0 / large_fraction, in_small) : phi_0;
}

bool has_phi(const RunGroup& group) {
  return summarize_measure(group, "phi").n > 0;
}

std::vector<RunGroup> groups_with_phi(const FigureInput& input) {
  std::vector<RunGroup> groups = bimodal_groups(input.runs);
  groups.erase(std::remove_if(groups.begin(), groups.end(), [](const RunGroup& group) { return !has_phi(group); }),
               groups.end());
  return groups;
}

/// Their labels, in order, and each label's groups.
std::vector<std::vector<RunGroup>> by_label(const std::vector<RunGroup>& groups) {
  std::vector<std::vector<RunGroup>> found;
  for (const RunGroup& group : groups) {
    const auto place = std::find_if(found.begin(), found.end(),
                                    [&](const auto& series) { return series.front().label == group.label; });
    if (place == found.end())
      found.push_back({group});
    else
      place->push_back(group);
  }
  return found;
}

const Psd& psd_of(const RunGroup& group) {
  return group.job().scene.psd;
}

std::set<double> values_of(const std::vector<RunGroup>& groups, double Psd::*field) {
  std::set<double> values;
  for (const RunGroup& group : groups)
    values.insert(psd_of(group).*field);
  return values;
}

void add_paper(DataBlocks& data, std::string& plots, double largest_ratio) {
  for (const std::string_view method : {"D&R", "LAMMPS", "dp3D"}) {
    Rows rows;
    for (const PaperBimodalRow& row : paper_bimodal_rows()) {
      if (row.method == method && row.has_figures() && row.outcome == "ok" && row.size_ratio <= largest_ratio)
        rows.push_back({row.size_ratio, row.phi.value});
    }
    const std::size_t index =
        data.add(fmt::format("paper, {}", method), std::array<std::string_view, 2>{"rho", "phi"}, rows);
    plots += fmt::format(", \\\n  'phi_over_size_ratio.dat' index {} using 1:2 with linespoints{} title '{}'", index,
                         paper_look(method), gnuplot_text(fmt::format("paper: {}", method)));
  }
}

} // namespace

Figures size_ratio_figure(const FigureInput& input) {
  const std::vector<RunGroup> groups = groups_with_phi(input);
  if (groups.empty()) {
    if (bimodal_groups(input.runs).empty())
      return {};
    return {{}, {not_yet("phi over the size ratio", "phi of a bimodal powder in 3D", input)}};
  }
  const std::set<double> ratios = values_of(groups, &Psd::size_ratio);
  const std::set<double> fractions = values_of(groups, &Psd::large_volume_fraction);
  // Over many fractions this is the Furnas plane, which has a figure of its own.
  const double fraction = fractions.count(kPaperBimodalFraction) > 0 ? kPaperBimodalFraction : *fractions.begin();
  if (ratios.size() < 2 || (fractions.size() > 1 && fractions.count(kPaperBimodalFraction) == 0))
    return {};

  Figure figure;
  figure.name = "phi_over_size_ratio";
  figure.width_cm = 14;
  figure.height_cm = 9;
  figure.caption =
      fmt::format("Packing fraction of binary mixtures over the size ratio, large spheres {:.4g} % of the volume: "
                  "means and standard "
                  "deviations of the exact φ; the paper's points in grey (its estimator is lower, and its mixtures are "
                  "those reached); "
                  "Farr and Groot's estimate of random close packing; the limit of Furnas for infinite size ratio.",
                  100 * fraction);
  DataBlocks data;
  Rows curve;
  const double largest = std::max(10.0, *ratios.rbegin());
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double ratio = std::pow(largest, static_cast<double>(i) / kCurvePoints);
    curve.push_back({ratio, oracle(ratio, fraction)});
  }
  const double limit = furnas_limit(curve.front()[1], fraction);
  const std::string file = "'phi_over_size_ratio.dat'";
  data.add("Farr and Groot", std::array<std::string_view, 2>{"rho", "phi"}, curve);
  std::string plots = fmt::format("plot {} index 0 using 1:2 with lines lc rgb 'black' lw 1.2 title 'Farr–Groot', \\\n"
                                  "  {} with lines lc rgb 'black' dt 2 lw 1.2 title 'Furnas limit'",
                                  file, limit);
  const Looks looks(input.runs);
  for (const std::vector<RunGroup>& series : by_label(groups)) {
    Rows rows;
    for (const RunGroup& group : series) {
      if (psd_of(group).large_volume_fraction != fraction)
        continue;
      const Summary phi = summarize_measure(group, "phi");
      rows.push_back({psd_of(group).size_ratio, phi.mean, bar(phi)});
    }
    const std::size_t index = data.add(series.front().label, std::array<std::string_view, 3>{"rho", "phi", "sd"}, rows);
    plots += fmt::format(", \\\n  {0} index {1} using 1:2 with linespoints{2} title '{3}', \\\n"
                         "  {0} index {1} using 1:2:3 with yerrorbars{4} notitle",
                         file, index, looks.of(series.front()), gnuplot_text(series.front().label),
                         solid(looks.of(series.front())));
  }
  if (fraction == kPaperBimodalFraction)
    add_paper(data, plots, largest);
  figure.commands = fmt::format("set logscale x\nset xrange [0.9:{}]\nset xtics (1, 2, 5, 10, 20, 40)\n"
                                "set xlabel 'size ratio ρ = R_L/R_S'\nset ylabel 'packing fraction φ'\n"
                                "set key outside right top\n{}\n",
                                1.1 * largest, plots);
  figure.data = {{figure.name + ".dat", data.text()}};
  return {{figure}, {}};
}

Figures furnas_figures(const FigureInput& input) {
  Figures out;
  const double phi_0 = oracle(1, 1);
  for (const std::vector<RunGroup>& series : by_label(groups_with_phi(input))) {
    if (values_of(series, &Psd::large_volume_fraction).size() < 3)
      continue; // no plane
    Figure figure;
    figure.name = "furnas_plane_" + slug(series.front().label);
    figure.caption = fmt::format("Binary mixtures by {} in the Furnas plane: φ over the share of the large spheres as "
                                 "reached, one colour for each "
                                 "size ratio; thin dashes: Farr and Groot's estimate; black: the limit of Furnas with "
                                 "φ = {:.3f} for equal spheres.",
                                 series.front().label, phi_0);
    figure.width_cm = 13;
    figure.height_cm = 9;
    DataBlocks data;
    Rows triangle;
    for (int i = 0; i <= kCurvePoints; ++i)
      triangle.push_back(
          {static_cast<double>(i) / kCurvePoints, furnas_limit(phi_0, static_cast<double>(i) / kCurvePoints)});
    const double apex = 1 / (2 - phi_0); // where both branches meet
    triangle.push_back({apex, furnas_limit(phi_0, apex)});
    std::sort(triangle.begin(), triangle.end());
    data.add("limit of Furnas", std::array<std::string_view, 2>{"X_L", "phi"}, triangle);
    const std::string file = fmt::format("'{}.dat'", figure.name);
    std::string plots =
        fmt::format("plot {} index 0 using 1:2 with lines lc rgb 'black' lw 1.2 title 'Furnas limit'", file);
    const std::set<double> ratios = values_of(series, &Psd::size_ratio);
    constexpr std::array kPoints = {7, 5, 9, 11, 13, 6, 4};
    std::size_t k = 0;
    for (const double ratio : ratios) {
      Rows rows;
      for (const RunGroup& group : series) {
        if (psd_of(group).size_ratio != ratio)
          continue;
        const Summary phi = summarize_measure(group, "phi");
        const Summary reached = summarize_measure(group, "X_L");
        rows.push_back({reached.n > 0 ? reached.mean : psd_of(group).large_volume_fraction, phi.mean, bar(phi),
                        psd_of(group).large_volume_fraction});
      }
      std::sort(rows.begin(), rows.end());
      // Yellow, the end of the palette, would vanish on paper.
      const double share =
          ratios.size() > 1 ? 0.85 * static_cast<double>(k) / static_cast<double>(ratios.size() - 1) : 0;
      const std::size_t index =
          data.add(fmt::format("rho = {}", ratio),
                   std::array<std::string_view, 4>{"X_L_reached", "phi", "sd", "X_L_stated"}, rows);
      const std::string look = fmt::format(" lc rgb {} pt {} lw 1.5", palette_hex(share), kPoints[k % kPoints.size()]);
      plots += fmt::format(", \\\n  {0} index {1} using 1:2 with linespoints{2} title 'ρ = {3}', \\\n"
                           "  {0} index {1} using 1:2:3 with yerrorbars{2} notitle",
                           file, index, look, ratio);
      if (ratio > 1) {
        Rows curve;
        for (int i = 0; i <= kCurvePoints; ++i) {
          const double fraction = static_cast<double>(i) / kCurvePoints;
          curve.push_back({fraction, oracle(ratio, fraction)});
        }
        const std::size_t dashed = data.add(fmt::format("Farr and Groot, rho = {}", ratio),
                                            std::array<std::string_view, 2>{"X_L", "phi"}, curve);
        plots += fmt::format(", \\\n  {} index {} using 1:2 with lines lc rgb {} lw 1 dt 2 notitle", file, dashed,
                             palette_hex(share));
      }
      ++k;
    }
    figure.commands = "set xrange [-0.02:1.02]\nset xlabel 'volume share X_L of the large spheres'\n"
                      "set ylabel 'packing fraction φ'\nset key outside right top\n" +
                      plots + "\n";
    figure.data = {{figure.name + ".dat", data.text()}};
    out.figures.push_back(figure);
  }
  return out;
}

} // namespace tamp
