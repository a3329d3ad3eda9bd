// Compares the methods of each scene.
#include "report/decision_table.h"

#include "report/cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace tamp {

namespace {

/// A need and the number of one run that judges it.
struct Need {
  const char* name;
  const char* quantity;
  bool smallest; ///< whether less is better
  CellStyle style;
  std::optional<double> (*judge)(const Run& run);
};

std::optional<double> quotient(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || *b <= 0)
    return std::nullopt;
  return *a / *b;
}

std::optional<double> time_per_sphere(const Run& run) {
  if (run.generation->timing.mode != TimingMode::exclusive)
    return std::nullopt; // beside other jobs a time says little
  return quotient(run.generation->timing.wall_s * 1e6, run.measure("N"));
}

std::optional<double> density(const Run& run) {
  return run.measure("phi");
}

std::optional<double> infidelity(const Run& run) {
  const std::string weighted = run.planned.job.scene.dimension == 2 ? "H_S" : "H_V";
  return quotient(run.measure(weighted), run.measure(weighted + "_floor"));
}

constexpr std::array kNeeds = {
    Need{"fastest", "time per sphere (µs)", true, CellStyle::fixed, time_per_sphere},
    Need{"densest", "⟨phi⟩", false, CellStyle::fixed, density},
    Need{"most faithful", "volume-weighted ⟨H⟩ over its floor", true, CellStyle::fixed, infidelity},
};

struct Candidate {
  std::string heading;
  Summary value;
  std::vector<std::string> keys;
};

std::vector<Candidate> ranking(std::span<const RunGroup> groups, const Need& need) {
  std::vector<Candidate> found;
  for (const RunGroup& group : groups) {
    Candidate candidate{group.heading, {}, {}};
    std::vector<double> values;
    for (const Run& run : group.runs) {
      const auto value = run.ok() ? need.judge(run) : std::nullopt;
      if (!value)
        continue;
      values.push_back(*value);
      candidate.keys.push_back(run.planned.key);
    }
    candidate.value = summarize(values);
    if (!values.empty())
      found.push_back(candidate);
  }
  std::stable_sort(found.begin(), found.end(), [&](const Candidate& a, const Candidate& b) {
    return need.smallest ? a.value.mean < b.value.mean : a.value.mean > b.value.mean;
  });
  return found;
}

std::string told_apart(const Summary& a, const Summary& b) {
  if (a.n < 2 || b.n < 2)
    return "unknown: one replicate";
  const double error = std::sqrt(a.sd * a.sd / static_cast<double>(a.n) + b.sd * b.sd / static_cast<double>(b.n));
  return std::abs(a.mean - b.mean) > kTellApart * error ? "yes" : "no";
}

Cell candidate_cell(const Candidate& candidate, const Need& need) {
  Cell cell;
  cell.value = candidate.value.mean;
  cell.spread = candidate.value.sd;
  cell.n = candidate.value.n;
  cell.style = need.style;
  cell.keys = candidate.keys;
  return cell;
}

std::string scene_in_words(const Scene& scene) {
  std::string words = fmt::format("{} powder in {}D", name_of(scene.psd.law), scene.dimension);
  if (scene.psd.law == Law::bimodal)
    words += fmt::format(", ⟨rho⟩ = {}, ⟨X_L⟩ = {}", scene.psd.size_ratio, scene.psd.large_volume_fraction);
  return words + fmt::format(", box {} {}, {}", fmt::join(scene.size, " × "), name_of(scene.unit),
                             scene.sides == Sides::walls ? "walls" : "periodic");
}

/// What methods must share to be compared.
std::string scene_content(const Scene& scene) {
  Job job;
  job.scene = scene;
  return canonical(job);
}

Panel scene_panel(std::span<const RunGroup> groups) {
  Panel panel{scene_in_words(groups.front().job().scene),
              {{"best method", "", ""},
               {"its value", "", ""},
               {"next method", "", ""},
               {"its value", "", ""},
               {"told apart", "", ""}},
              {}};
  for (const Need& need : kNeeds) {
    const std::vector<Candidate> order = ranking(groups, need);
    if (order.size() < 2)
      continue;
    panel.groups.push_back(
        {fmt::format("{}: {}", need.name, need.quantity),
         {},
         {{"",
           {word_cell(order[0].heading), candidate_cell(order[0], need), word_cell(order[1].heading),
            candidate_cell(order[1], need), word_cell(told_apart(order[0].value, order[1].value))}}}});
  }
  return panel;
}

} // namespace

Table decision_table(std::span<const Run> runs) {
  std::vector<std::vector<Run>> scenes;
  std::map<std::string, std::size_t> index;
  for (const Run& run : runs) {
    if (!run.ok())
      continue;
    const auto [place, is_new] = index.emplace(scene_content(run.planned.job.scene), scenes.size());
    if (is_new)
      scenes.emplace_back();
    scenes[place->second].push_back(run);
  }
  Table table;
  table.name = "decision";
  table.caption = "Which method for which need, computed from the records of this campaign.";
  for (const std::vector<Run>& scene : scenes) {
    const std::vector<RunGroup> groups = group_runs(scene); // headings tell apart only what this scene has
    Panel panel = groups.size() < 2 ? Panel{} : scene_panel(groups);
    if (!panel.groups.empty())
      table.panels.push_back(std::move(panel));
  }
  if (!table.panels.empty()) {
    table.notes = {
        {"How it is judged",
         fmt::format("Only methods run in the same powder and box are compared. Times count only where each job ran "
                     "alone. Faithful: the Hellinger distance by volume (2D: surface) in units of what perfect random "
                     "sampling of as many particles leaves. Told apart: the means differ by more than {} standard "
                     "errors. Which method comes closest to a measured powder is not judged: no campaign states an "
                     "experimental packing fraction.",
                     kTellApart)}};
  }
  return table;
}

} // namespace tamp
