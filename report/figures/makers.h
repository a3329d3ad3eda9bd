// The makers of figures, one for each kind, and what they share.
#pragma once

#include "engine/model/packing.h"
#include "report/figures/figure.h"
#include "report/runs.h"
#include "report/statistics.h"

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// The packing of a generation job; throws Error if it cannot be read.
using ReadPacking = std::function<Packing(const std::string& key)>;

/// What figures are made from.
struct FigureInput {
  std::span<const Run> runs;
  std::vector<RunGroup> groups; ///< group_runs(runs)
  std::string command;          ///< that would run the jobs that are missing
  ReadPacking read_packing;     ///< empty: no figure of a packing
  std::size_t pixels;           ///< across the picture of a packing
};

/// The look of each method label in all figures of a report (style.h), in the order of the campaign.
class Looks {
public:
  explicit Looks(std::span<const Run> runs);
  [[nodiscard]] std::string of(const RunGroup& group) const;

private:
  std::map<std::string, std::string> by_label_;
};

/// Standard deviation for an error bar: NaN, no bar, for a single replicate.
double bar(const Summary& summary);

/// From which ratio of largest to smallest on an axis is logarithmic.
inline constexpr double kLogRatio = 5;

/// "lognormal, 3D, 133 µm".
std::string scene_words(const Scene& scene);

/// A sentence on a figure whose numbers are planned and not recorded.
std::string not_yet(std::string_view figure, std::string_view needs, const FigureInput& input);

Figures size_ratio_figure(const FigureInput& input);   ///< phi over the size ratio
Figures furnas_figures(const FigureInput& input);      ///< phi over X_L, one for each method label
Figures convergence_figures(const FigureInput& input); ///< phi and H over the size of the box
Figures scaling_figures(const FigureInput& input);     ///< time over N, with fits and residuals
Figures contact_figures(const FigureInput& input);     ///< phi over friction and work of adhesion
Figures cost_figures(const FigureInput& input);        ///< accuracy against time
Figures knob_figures(const FigureInput& input);        ///< error and time over accuracy knobs
Figures packing_figures(const FigureInput& input);     ///< histograms, and packings drawn

} // namespace tamp
