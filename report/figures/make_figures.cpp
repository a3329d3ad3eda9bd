// Lists the figures' makers and draws what they make.
#include "report/figures/make_figures.h"

#include "report/figures/gnuplot.h"
#include "report/figures/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tamp {

namespace {

/// In the order of the page.
struct Maker {
  Figures (*make)(const FigureInput& input);
  const char* content;
  const char* campaign; ///< one that has such a figure
};
constexpr std::array kMakers = {
    Maker{cost_figures, "accuracy against time", "lognormal-3d.json"},
    Maker{knob_figures, "error over accuracy knobs", "accuracy-cost.json"},
    Maker{packing_figures, "packings and their radii", "quickstart.json"},
    Maker{size_ratio_figure, "φ over the size ratio", "bimodal-3d.json"},
    Maker{furnas_figures, "the Furnas plane", "furnas.json"},
    Maker{convergence_figures, "convergence with the size of the box", "domain-size.json"},
    Maker{scaling_figures, "time over the number of particles", "scaling.json"},
    Maker{contact_figures, "φ over friction and adhesion", "contact-variants.json"},
};

/// What gnuplot left undone.
std::string not_drawn(const std::vector<std::string>& names, const std::string& why) {
  std::string sentence = "Figures not drawn (" + why.substr(0, why.find('\n')) + "). In the folder of this report:";
  sentence += " gnuplot";
  for (const std::string& name : names)
    sentence += " " + name + ".gp";
  return sentence + "; gnuplot comes with Debian's package gnuplot-nox.";
}

/// Where figures are to be had that this campaign has no numbers for; it may have them once all of it has run.
std::string elsewhere_sentence(const std::string& figures, const FigureInput& input) {
  const bool to_run = std::any_of(input.runs.begin(), input.runs.end(),
                                  [](const Run& run) { return !run.generation && run.barrier() == nullptr; });
  return fmt::format("Figures that this campaign has no numbers for{}, and a campaign that has: {}; tamp run FILE and "
                     "tamp report FILE make them.",
                     to_run ? " yet (some may come with what has not run: " + input.command + ")" : "", figures);
}

} // namespace

ReportFigures make_figures(std::span<const Run> runs, const std::string& command, const FigureSettings& settings) {
  ReportFigures out;
  if (!settings.wanted)
    return out;
  const FigureInput input{runs, group_runs(runs), command, settings.read_packing, settings.pixels};
  std::vector<Figure> figures;
  std::string elsewhere;
  for (const Maker& maker : kMakers) {
    Figures made = maker.make(input);
    if (made.figures.empty() && made.missing.empty())
      elsewhere += fmt::format("{}{} (campaigns/{})", elsewhere.empty() ? "" : ", ", maker.content, maker.campaign);
    figures.insert(figures.end(), made.figures.begin(), made.figures.end());
    out.missing.insert(out.missing.end(), made.missing.begin(), made.missing.end());
  }
  if (!elsewhere.empty())
    out.missing.push_back(elsewhere_sentence(elsewhere, input));
  if (figures.empty())
    return out;
  const Drawings drawings = draw(figures, settings.gnuplot);
  out.files.push_back({std::string(kStyleFile), style_script()});
  std::vector<std::string> undone;
  for (Figure& figure : figures) {
    out.files.push_back({figure.name + ".gp", figure_script(figure)});
    for (FigureFile& file : figure.data)
      out.files.push_back(std::move(file));
    const auto drawing = drawings.by_name.find(figure.name);
    if (drawing == drawings.by_name.end()) {
      undone.push_back(figure.name);
      continue;
    }
    out.files.push_back({figure.name + ".svg", drawing->second.svg});
    out.files.push_back({figure.name + ".pdf", drawing->second.pdf});
    out.files.push_back({figure.name + ".png", drawing->second.png});
    out.drawn.push_back({figure.name, figure.caption, drawing->second.svg});
  }
  if (!undone.empty())
    out.missing.push_back(out.trouble.emplace_back(not_drawn(undone, drawings.why)));
  return out;
}

} // namespace tamp
