// What the makers of figures share.
#include "report/figures/makers.h"

#include "report/cells.h"
#include "report/figures/style.h"

#include <fmt/format.h>

#include <cmath>

namespace tamp {

Looks::Looks(std::span<const Run> runs) {
  std::map<MethodName, std::size_t> variants;
  for (const Run& run : runs) {
    if (by_label_.count(run.planned.label) > 0)
      continue;
    const MethodName method = run.planned.job.method.name;
    by_label_[run.planned.label] = series_look(method, variants[method]++);
  }
}

std::string Looks::of(const RunGroup& group) const {
  return by_label_.at(group.label);
}

double bar(const Summary& summary) {
  return summary.n > 1 ? summary.sd : std::nan("");
}

std::string scene_words(const Scene& scene) {
  std::string words(name_of(scene.psd.law));
  if (scene.psd.law == Law::bimodal)
    words += fmt::format(", ρ = {}, X_L = {}", scene.psd.size_ratio, scene.psd.large_volume_fraction);
  words += fmt::format(", {}D, ", scene.dimension);
  for (std::size_t i = 0; i < scene.size.size(); ++i) {
    if (i == 0 || scene.size[i] != scene.size[0])
      words += fmt::format("{}{:.6g}", i == 0 ? "" : " × ", scene.size[i] * micrometres(scene.unit));
  }
  words += " µm";
  return scene.count > 0 ? words + fmt::format(", {} particles", scene.count) : words;
}

std::string not_yet(std::string_view figure, std::string_view needs, const FigureInput& input) {
  return fmt::format("No figure of {} yet: it needs {}. To run what is missing: {}", figure, needs, input.command);
}

} // namespace tamp
