// The first packing of each powder and method: its radii as histograms beside the law, and a picture of it.
#include "engine/base/error.h"
#include "engine/model/size_law.h"
#include "report/cells.h"
#include "report/figures/makers.h"
#include "report/figures/picture.h"
#include "report/figures/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

namespace tamp {

namespace {

using Rows = std::vector<std::vector<double>>;

/// More packings than this are not read: each adds about half a megabyte to the page.
constexpr std::size_t kMostPackings = 12;
constexpr std::size_t kBins = 40;
/// Places at which the cumulative curves are drawn.
constexpr std::size_t kCurvePoints = 240;

/// Edges of n bins over a range, equal in logarithms where it is wide.
std::vector<double> edges_between(double low, double high, std::size_t n) {
  std::vector<double> edges;
  for (std::size_t i = 0; i <= n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(n);
    edges.push_back(high > kLogRatio * low ? low * std::pow(high / low, share) : low + share * (high - low));
  }
  return edges;
}

/// Share of the sum of r^k of sorted radii that those up to each edge have.
std::vector<double> cumulative(const std::vector<double>& sorted, int k, const std::vector<double>& edges) {
  std::vector<double> shares;
  double sum = 0;
  std::size_t i = 0;
  for (const double edge : edges) {
    for (; i < sorted.size() && sorted[i] <= edge; ++i)
      sum += std::pow(sorted[i], k);
    shares.push_back(sum);
  }
  for (; i < sorted.size(); ++i)
    sum += std::pow(sorted[i], k);
  for (double& share : shares)
    share /= sum;
  return shares;
}

/// A round number of about this size or below: 1, 2 or 5 times a power of ten.
double round_below(double aim) {
  const double power = std::pow(10, std::floor(std::log10(aim)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= aim)
      return digit * power;
  return power;
}

/// Marks of a logarithmic axis at equal ratios from end to end: powers of ten alone may be one or none.
std::string even_marks(std::string_view axis, double low, double high) {
  constexpr int kMarks = 4;
  std::string marks;
  for (int i = 0; i < kMarks; ++i) {
    const double radius = low * std::pow(high / low, static_cast<double>(i) / (kMarks - 1));
    marks += fmt::format("{}'{:.2g}' {}", i == 0 ? "" : ", ", radius, radius);
  }
  return fmt::format("set {}tics ({})\n", axis, marks);
}

struct Subject {
  const RunGroup& group;
  const Packing& packing;
  std::string name; ///< ending of the figure's name
  std::string words;
};

Figure histogram_figure(const Subject& subject) {
  const Job& job = subject.group.job();
  const int dimension = static_cast<int>(job.scene.dimension);
  const SizeLaw law(job.scene.psd, dimension);
  std::vector<double> radii = subject.packing.radii;
  std::sort(radii.begin(), radii.end());
  const double low = std::min(law.smallest(), radii.front());
  const double high = std::max(law.largest(), radii.back());
  // A margin keeps the classes of discrete laws off the edges of bins.
  const std::vector<double> edges = edges_between(low * 0.97, high * 1.03, kBins);
  const std::vector<double> fine = edges_between(low * 0.97, high * 1.03, kCurvePoints);
  const double um = micrometres(job.scene.unit);

  Figure figure;
  figure.name = "radii_" + subject.name;
  figure.width_cm = 17;
  figure.height_cm = 7.5;
  figure.caption =
      fmt::format("Radii of {}: share of the particles in each bin, by number and by {}; bars: the packing, "
                  "black: the law; rising lines, right axis: cumulative.",
                  subject.words, dimension == 2 ? "surface" : "volume");
  const double left = edges.front() * um;
  const double right = edges.back() * um;
  const std::string axis = high > kLogRatio * low ? "set logscale x\n" + even_marks("x", left, right)
                                                  : fmt::format("set xtics {}\n", round_below((right - left) / 3));
  DataBlocks data;
  figure.commands =
      fmt::format("set multiplot layout 1,2\n{}set xrange [{}:{}]\nset yrange [0:*]\nset y2range [0:1.02]\n"
                  "set border 11\nset y2tics 0.2\n"
                  "set key at graph 0.5, graph 1.02 center bottom horizontal maxrows 1\nset tmargin 2.5\n"
                  "set xlabel 'radius (µm)'\nset y2label 'cumulative'\n",
                  axis, left, right);
  const std::string file = fmt::format("'{}.dat'", figure.name);
  const std::string colour = method_colour(job.method.name);
  for (const int weight : {0, dimension}) {
    const std::vector<double> shares = cumulative(radii, weight, edges);
    Rows bins;
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
      bins.push_back({edges[i] * um, edges[i + 1] * um, shares[i + 1] - shares[i],
                      law.weighted_cdf(edges[i + 1], weight) - law.weighted_cdf(edges[i], weight)});
    bins.push_back({edges.back() * um, edges.back() * um, 0, bins.back()[3]}); // ends the law's last step
    const std::vector<double> rising = cumulative(radii, weight, fine);
    Rows curve;
    for (std::size_t i = 0; i < fine.size(); ++i)
      curve.push_back({fine[i] * um, rising[i], law.weighted_cdf(fine[i], weight)});
    const char* by = weight == 0 ? "number" : dimension == 2 ? "surface" : "volume";
    const std::size_t first =
        data.add(fmt::format("by {}", by),
                 std::array<std::string_view, 4>{"r_low_um", "r_high_um", "share", "share_of_law"}, bins);
    data.add(fmt::format("by {}, cumulative", by), std::array<std::string_view, 3>{"r_um", "share", "share_of_law"},
             curve);
    figure.commands += fmt::format("set ylabel 'share by {4} in a bin'\n"
                                   "plot {0} index {1} using (sqrt($1*$2)):3:1:2:(0):3 with boxxyerror{3} fs solid "
                                   "0.45 noborder title 'packing', \\\n"
                                   "  {0} index {1} using 1:4 with steps lc rgb 'black' lw 1 title 'law', \\\n"
                                   "  {0} index {2} using 1:2 axes x1y2 with lines{3} lw 1.6 notitle, \\\n"
                                   "  {0} index {2} using 1:3 axes x1y2 with lines lc rgb 'black' dt 2 lw 1 notitle\n",
                                   file, first, first + 1, colour, by);
  }
  figure.commands += "unset multiplot\n";
  figure.data = {{figure.name + ".dat", data.text()}};
  return figure;
}

Figure picture_figure(const Subject& subject, std::size_t pixels) {
  const Packing& packing = subject.packing;
  const double um = micrometres(packing.unit);
  const ColourScale scale = colour_scale(packing);
  const Picture picture = draw_packing(packing, scale, pixels);
  const double width = picture.pixel * um * static_cast<double>(picture.width);
  const double height = picture.pixel * um * static_cast<double>(picture.height);
  Figure figure;
  figure.name = "packing_" + subject.name;
  figure.width_cm = 11;
  figure.height_cm = std::clamp(8.5 * height / width + 2.0, 4.0, 16.0);
  figure.caption = fmt::format("Packing of {}, {} particles, coloured by radius{}.", subject.words, packing.count(),
                               packing.dimension == 2 ? "" : "; one octant of the box is cut away");
  figure.commands =
      fmt::format("set size ratio -1\nset xrange [0:{0}]\nset yrange [0:{1}]\nunset grid\nunset key\n"
                  "set cbrange [{2}:{3}]\n{4}set cblabel 'radius (µm)'\n",
                  width, height, scale.low * um, scale.high * um,
                  scale.logarithmic ? "set logscale cb\n" + even_marks("cb", scale.low * um, scale.high * um) : "");
  if (packing.dimension == 2) {
    figure.commands += "set xlabel 'x (µm)'\nset ylabel 'y (µm)'\n";
  } else { // oblique: no axis to read a length from
    const double length = round_below(width / 5);
    figure.commands += fmt::format("unset border\nunset xtics\nunset ytics\n"
                                   "set arrow from 0,{1} to {0},{1} nohead lw 3 lc rgb 'black' front\n"
                                   "set label '{0} µm' at {2},{3} center front\n",
                                   length, 0.05 * height, length / 2, 0.085 * height);
  }
  figure.commands += fmt::format(
      "plot '{0}.ppm' binary skip={1} array=({2},{3}) dx={4} dy={4} origin=({5},{5}) flip=y "
      "format='%uchar' using 1:2:3 with rgbimage notitle, \\\n  1/0 with lines lc palette notitle\n",
      figure.name, picture.ppm_header(), picture.width, picture.height, picture.pixel * um, picture.pixel * um / 2);
  figure.data = {{figure.name + ".ppm", picture.ppm()}};
  return figure;
}

/// The label and, where one label has several groups, what the sweep says of this one: "d_r_size_ratio_2".
std::string short_name(const RunGroup& group) {
  std::string words = group.label;
  if (group.heading != group.label) {
    for (const auto& [path, value] : group.runs.front().planned.point)
      words += " " + path.substr(path.rfind('/') + 1) + " " + value;
  }
  return slug(words);
}

} // namespace

Figures packing_figures(const FigureInput& input) {
  Figures out;
  std::set<std::string> names;
  std::size_t drawn = 0;
  std::size_t left_out = 0;
  bool wanting = false;
  for (const RunGroup& group : input.groups) {
    const auto first = std::find_if(group.runs.begin(), group.runs.end(),
                                    [](const Run& run) { return run.ok() && !run.generation->packing_file.empty(); });
    if (first == group.runs.end()) {
      wanting = true;
      continue;
    }
    if (!input.read_packing)
      continue;
    if (drawn == kMostPackings) {
      ++left_out;
      continue;
    }
    ++drawn;
    std::string name = short_name(group);
    for (int k = 2; !names.insert(name).second; ++k)
      name = fmt::format("{}_{}", short_name(group), k);
    try {
      const Packing packing = input.read_packing(first->planned.key);
      if (packing.count() == 0)
        continue;
      const Subject subject{group, packing, name,
                            fmt::format("{}: {}, replicate {}", group.label, scene_words(group.job().scene),
                                        first->planned.job.replicate)};
      out.figures.push_back(picture_figure(subject, input.pixels));
      out.figures.push_back(histogram_figure(subject));
    } catch (const Error& error) {
      out.missing.push_back(fmt::format("No figure of the packing of {}: {}. To make what is lost again: {}",
                                        group.heading, error.what(), input.command));
    }
  }
  if (wanting && drawn == 0)
    out.missing.push_back(not_yet("a packing and its radii", "a packing", input));
  if (left_out > 0)
    out.missing.push_back(
        fmt::format("{} powders are drawn, {} more are left out to keep the page small; a campaign file "
                    "with those alone, run into the same store, draws them without making them again.",
                    kMostPackings, left_out));
  return out;
}

} // namespace tamp
