// Compares the methods of each scene.
#include "report/decision_table.h"

#include "report/cells.h"
#include "report/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
  std::string_view unit;
  bool smallest;   ///< whether less is better
  bool of_density; ///< whether packings of another mixture are out of the question
  std::optional<double> (*judge)(const Run& run, double phi_exp);
};

/// Of the whole way from the scene.
std::optional<double> time_per_sphere(const Run& run, double /*phi_exp*/) {
  const auto seconds = run.way_seconds(TimingMode::exclusive); // beside other work a time says little
  const auto count = run.measure("N");
  return seconds && count && *count > 0 ? std::optional(*seconds * 1e6 / *count) : std::nullopt;
}

std::optional<double> density(const Run& run, double /*phi_exp*/) {
  return density_of(run);
}

std::optional<double> distance(const Run& run, double phi_exp) {
  const auto phi = density(run, phi_exp);
  return phi && stated(phi_exp) ? std::optional(std::abs(*phi - phi_exp)) : std::nullopt;
}

std::optional<double> distance_times_cost(const Run& run, double phi_exp) {
  const auto far = distance(run, phi_exp);
  const auto time = time_per_sphere(run, phi_exp);
  return far && time ? std::optional(*far * *time) : std::nullopt;
}

std::optional<double> excess(const Run& run, const std::string& distance) {
  const auto h = run.measure(distance);
  const auto floor = run.measure(distance + "_floor");
  return h && floor ? std::optional(*h - *floor) : std::nullopt;
}

std::optional<double> excess_by_number(const Run& run, double /*phi_exp*/) {
  return excess(run, "H_N");
}

std::optional<double> excess_by_volume(const Run& run, double /*phi_exp*/) {
  return excess(run, run.planned.job.scene.dimension == 2 ? "H_S" : "H_V");
}

std::optional<double> larger_excess(const Run& run, double phi_exp) {
  const auto number = excess_by_number(run, phi_exp);
  const auto volume = excess_by_volume(run, phi_exp);
  return number && volume ? std::max(number, volume) : number ? number : volume;
}

constexpr Need kFastest{"fastest", "time per sphere (µs)", "us", true, false, time_per_sphere};
constexpr Need kDensest{"densest", "⟨phi⟩", "1", false, true, density};
constexpr Need kFaithful{"most faithful", "larger excess of ⟨H⟩ over its floor", "1", true, false, larger_excess};
constexpr Need kByNumber{"of these", "excess by number", "1", true, false, excess_by_number};
constexpr Need kByVolume{"of these", "excess by volume (2D: surface)", "1", true, false, excess_by_volume};
constexpr Need kClosest{"closest to the experiment", "|⟨phi⟩ − ⟨phi_exp⟩|", "1", true, true, distance};
constexpr Need kPerCost{"closest per cost", "|⟨phi⟩ − ⟨phi_exp⟩| times time per sphere (µs)", "us", true, true,
                        distance_times_cost};

/// H of a packing within its floor: a perfect sampler seldom reaches more than this many floors.
constexpr double kWithinFloor = 2;

/// A mixture whose share of large spheres is further than this from the scene's is another powder.
constexpr double kSameMixture = 0.05;

struct Candidate {
  std::string heading;
  std::vector<const Run*> runs;
};

/// What a candidate's runs have of a need.
struct Judged {
  std::string heading;
  Summary value;
  std::vector<ComparedRun> sample;
  const Candidate* candidate = nullptr;
};

Judged judged(const Candidate& candidate, const Need& need, double phi_exp) {
  Judged found{candidate.heading, {}, {}, &candidate};
  std::vector<double> values;
  for (const Run* run : candidate.runs) {
    if (const auto value = run->ok() ? need.judge(*run, phi_exp) : std::nullopt) {
      values.push_back(*value);
      found.sample.push_back(
          {"", run->origin(), run->planned.key, run->generation->packing_sha256, {{need.quantity, *value}}});
    }
  }
  found.value = summarize(values);
  return found;
}

std::vector<Judged> ranking(std::span<const Candidate> candidates, const Need& need, double phi_exp) {
  std::vector<Judged> found;
  for (const Candidate& candidate : candidates) {
    Judged one = judged(candidate, need, phi_exp);
    if (one.value.n > 0)
      found.push_back(std::move(one));
  }
  std::stable_sort(found.begin(), found.end(), [&](const Judged& a, const Judged& b) {
    return need.smallest ? a.value.mean < b.value.mean : a.value.mean > b.value.mean;
  });
  return found;
}

/// The best against the next, by the test of `tamp compare`, corrected for as many others as the best is chosen among.
std::string told_apart(std::span<const Judged> order) {
  std::vector<double> p;
  for (const Judged& other : order.subspan(1)) {
    const Comparison both = compare_runs(order[0].sample, other.sample);
    p.push_back(both.quantities.at(0).p);
  }
  if (!std::isfinite(p[0])) {
    if (order[0].value.mean == order[1].value.mean)
      return "no: equal";
    return order[0].value.n < 2 || order[1].value.n < 2 ? "unknown: one replicate" : "unknown: no spread";
  }
  p.erase(std::remove_if(p.begin(), p.end(), [](double x) { return !std::isfinite(x); }), p.end());
  const double adjusted = holm_adjusted(p)[0];
  return fmt::format("{} (p = {:.2g})", adjusted < kTellApart ? "yes" : "no", adjusted);
}

/// `quantity`: its name in CSV files.
Cell judged_cell(const Judged& judged, const Need& need, const char* quantity) {
  Cell cell;
  cell.quantity = quantity;
  cell.unit = need.unit;
  cell.value = judged.value.mean;
  cell.spread = judged.value.sd;
  cell.n = judged.value.n;
  for (const ComparedRun& run : judged.sample) {
    cell.keys.push_back(run.key);
    cell.run_values.push_back(run.measures.begin()->second);
  }
  return cell;
}

/// `quantity`: its name in CSV files.
Cell named_cell(const char* quantity, std::string word) {
  Cell cell = word_cell(std::move(word));
  cell.quantity = quantity;
  return cell;
}

Group need_group(const Need& need, std::string best, std::span<const Judged> order, std::string apart) {
  return {fmt::format("{}: {}", need.name, need.quantity),
          {},
          {{"",
            {named_cell("best", std::move(best)), judged_cell(order[0], need, "best value"),
             named_cell("next", order[1].heading), judged_cell(order[1], need, "next value"),
             named_cell("told apart", std::move(apart))}}}};
}

/// Whether the method places all the radii it draws from the law: two that do differ in H by luck alone.
bool keeps_draws(const Run& run) {
  const MethodName name = run.planned.job.method.name;
  return run.way.empty() && (name == MethodName::dem_gravity || name == MethodName::dem_isostatic ||
                             name == MethodName::lammps_gravity || name == MethodName::lammps_isostatic);
}

/// The candidates with those joined into one whose radii are independent draws of the law.
std::vector<Candidate> joined_draws(std::span<const Candidate> candidates) {
  std::vector<Candidate> joined;
  Candidate* draws = nullptr;
  joined.reserve(candidates.size()); // `draws` stays where it is
  for (const Candidate& candidate : candidates) {
    const bool keeps = keeps_draws(*candidate.runs.front());
    if (keeps && draws != nullptr) {
      draws->heading += ", " + candidate.heading;
      draws->runs.insert(draws->runs.end(), candidate.runs.begin(), candidate.runs.end());
      continue;
    }
    joined.push_back(candidate);
    if (keeps)
      draws = &joined.back();
  }
  return joined;
}

bool is_within_floor(const Candidate& candidate) {
  for (const char* distance : {"H_N", "H_S", "H_V"}) {
    std::vector<double> ratios;
    for (const Run* run : candidate.runs) {
      const auto h = run->measure(distance);
      const auto floor = run->measure(std::string(distance) + "_floor");
      if (run->ok() && h && floor && *floor > 0)
        ratios.push_back(*h / *floor);
    }
    if (!ratios.empty() && summarize(ratios).mean > kWithinFloor)
      return false;
  }
  return true;
}

void add_faithful(std::span<const Candidate> candidates, double phi_exp, Panel& panel, std::string& notes) {
  const std::vector<Candidate> joined = joined_draws(candidates);
  const std::vector<Judged> order = ranking(joined, kFaithful, phi_exp);
  if (order.size() == 1 && candidates.size() > 1)
    notes +=
        fmt::format(" {}: which is the most faithful cannot be asked, as the radii are drawn alike.", order[0].heading);
  if (order.size() < 2)
    return;
  const std::string best = is_within_floor(*order[0].candidate)
                               ? order[0].heading
                               : fmt::format("none within {:g} floors; nearest: {}", kWithinFloor, order[0].heading);
  panel.groups.push_back(need_group(kFaithful, best, order, told_apart(order)));
  for (const Need* part : {&kByNumber, &kByVolume}) {
    const std::array both = {judged(*order[0].candidate, *part, phi_exp), judged(*order[1].candidate, *part, phi_exp)};
    if (both[0].value.n > 0 && both[1].value.n > 0)
      panel.groups.push_back(need_group(*part, both[0].heading, both, ""));
  }
}

/// Mean share of the large spheres where it is far from what the scene asks for.
std::optional<double> other_mixture(const Candidate& candidate) {
  const Psd& psd = candidate.runs.front()->planned.job.scene.psd;
  if (psd.law != Law::bimodal || psd.size_ratio == 1)
    return std::nullopt;
  std::vector<double> shares;
  for (const Run* run : candidate.runs) {
    if (const auto share = run->ok() ? run->measure("X_L") : std::nullopt)
      shares.push_back(*share);
  }
  const double mean = summarize(shares).mean;
  return std::abs(mean - psd.large_volume_fraction) > kSameMixture ? std::optional(mean) : std::nullopt;
}

std::string scene_in_words(const Scene& scene, std::span<const Candidate> candidates) {
  std::vector<double> edges;
  for (const double edge : scene.size)
    edges.push_back(edge * micrometres(scene.unit));
  std::string words = fmt::format("{} powder in {}D", name_of(scene.psd.law), scene.dimension);
  if (scene.psd.law == Law::bimodal)
    words += fmt::format(", ⟨rho⟩ = {}, ⟨X_L⟩ = {}", scene.psd.size_ratio, scene.psd.large_volume_fraction);
  words +=
      fmt::format(", box {:.6g} µm, {}", fmt::join(edges, " × "), scene.sides == Sides::walls ? "walls" : "periodic");
  std::string all_round;
  for (const Candidate& candidate : candidates) {
    if (is_periodic_all_round(candidate.runs.front()->planned.job.method))
      all_round += (all_round.empty() ? "" : ", ") + candidate.heading;
  }
  return all_round.empty() ? words : fmt::format("{}; periodic on all sides: {}", words, all_round);
}

/// What methods must share to be compared.
std::string scene_content(const Scene& scene) {
  Job job;
  job.scene = scene;
  return canonical(job);
}

Panel scene_panel(std::span<const RunGroup> groups, double phi_exp, std::string& notes) {
  std::vector<Candidate> candidates;
  std::string none;
  for (const RunGroup& group : groups) {
    if (group.ok_count() == 0) {
      if (const std::string words = other_outcomes(group); !words.empty())
        none += fmt::format("{}{} ({})", none.empty() ? "" : ", ", group.heading, words);
      continue;
    }
    candidates.push_back({group.heading, {}});
    for (const Run& run : group.runs)
      candidates.back().runs.push_back(&run);
  }
  if (candidates.empty())
    return {};
  std::vector<Candidate> of_powder;
  std::string others;
  for (const Candidate& candidate : candidates) {
    if (const auto share = other_mixture(candidate))
      others += fmt::format("{}{} (⟨X_L⟩ = {:.3f})", others.empty() ? "" : ", ", candidate.heading, *share);
    else
      of_powder.push_back(candidate);
  }

  Panel panel{scene_in_words(groups.front().job().scene, candidates),
              {{"best method", "", ""},
               {"its value", "", ""},
               {"next method", "", ""},
               {"its value", "", ""},
               {"told apart", "", ""}},
              {},
              "Need"};
  std::string remarks;
  for (const Need* need : {&kFastest, &kDensest, &kFaithful, &kClosest, &kPerCost}) {
    if (need == &kFaithful) {
      add_faithful(candidates, phi_exp, panel, remarks);
      continue;
    }
    const std::vector<Judged> order = ranking(need->of_density ? of_powder : candidates, *need, phi_exp);
    if (order.size() >= 2)
      panel.groups.push_back(need_group(*need, order[0].heading, order, told_apart(order)));
  }
  if (!none.empty())
    remarks += fmt::format(" Without a packing, so not judged: {}.", none);
  if (!others.empty() && candidates.size() > 1)
    remarks += fmt::format(" Another mixture than the scene's ⟨X_L⟩ = {}, so not judged by density: {}.",
                           groups.front().job().scene.psd.large_volume_fraction, others);
  if (!remarks.empty())
    notes += fmt::format(" {}:{}", panel.title, remarks);
  return panel;
}

Note judging_note(double phi_exp) {
  return {
      "How it is judged",
      fmt::format(
          "Only methods run in the same powder and box are compared. Times count only where each job ran alone, and "
          "are those of the whole way from the scene. Packing fraction: ⟨phi⟩ in the central sub-box; of packings that "
          "are periodic on all sides ⟨phi_box⟩, of the whole box. Faithful: the larger of what the Hellinger distances "
          "by number and by volume (2D: surface) have above what perfect random sampling of as many particles leaves; "
          "methods that place every radius they draw from the law differ in it by luck alone and are judged as one. "
          "Told apart: Student's t test of the best against the next, in pairs where both come from the same packings, "
          "else Welch's, at {:g} %; p is Holm's, for as many others as the best is chosen among. {}",
          100 * kTellApart,
          stated(phi_exp) ? fmt::format("⟨phi_exp⟩ = {}, as the campaign states it; which setting of a method would "
                                        "meet it is another question.",
                                        phi_exp)
                          : "Which method comes closest to a measured powder is not judged: the campaign states no "
                            "report/phi_exp.")};
}

} // namespace

Table decision_table(std::span<const Run> runs, double phi_exp) {
  std::vector<std::vector<Run>> scenes;
  std::map<std::string, std::size_t> index;
  for (const Run& run : runs) {
    const auto [place, is_new] = index.emplace(scene_content(run.planned.job.scene), scenes.size());
    if (is_new)
      scenes.emplace_back();
    scenes[place->second].push_back(run);
  }
  Table table;
  table.name = "decision";
  table.caption = "Which method for which need, computed from the records of this campaign.";
  std::string notes;
  for (const std::vector<Run>& scene : scenes) {
    const std::vector<RunGroup> groups = group_runs(scene); // headings tell apart only what this scene has
    Panel panel = groups.size() < 2 ? Panel{} : scene_panel(groups, phi_exp, notes);
    if (!panel.groups.empty())
      table.panels.push_back(std::move(panel));
  }
  if (table.panels.empty())
    return table;
  table.notes = {judging_note(phi_exp)};
  if (!notes.empty())
    table.notes.push_back({"Not judged", notes.substr(1)});
  return table;
}

} // namespace tamp
