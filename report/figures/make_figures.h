// The figures of a report: which there are, drawn, as files.
#pragma once

#include "report/figures/makers.h"

namespace tamp {

/// Whether a report has figures, and where they come from.
struct FigureSettings {
  bool wanted = false;
  ReadPacking read_packing = {}; ///< empty: no figure of a packing
  std::string gnuplot = "gnuplot";
  std::size_t pixels = 720; ///< across the picture of a packing
};

struct DrawnFigure {
  std::string name;
  std::string caption;
  std::string svg;
};

/// `files`: the style script, and of each figure the script, its data and, where gnuplot could draw it, SVG, PDF and
/// PNG. `drawn`: those that it could draw. `missing`: sentences on what there is not, each with the command that helps;
/// `trouble`: those of them that the user would not expect.
struct ReportFigures {
  std::vector<DrawnFigure> drawn;
  std::vector<FigureFile> files;
  std::vector<std::string> missing;
  std::vector<std::string> trouble;
};

/// The same bytes for the same records and packings.
ReportFigures make_figures(std::span<const Run> runs, const std::string& command, const FigureSettings& settings);

} // namespace tamp
