// Notes on lines, columns, scenes and times.
#include "engine/model/parameter.h"
#include "report/lognormal_table.h"
#include "report/notes.h"
#include "report/quantities.h"

#include <fmt/format.h>

#include <set>
#include <variant>

namespace tamp {

namespace {

std::string in_words(const JsonLeaf& leaf) {
  if (const auto* flag = std::get_if<bool>(&leaf))
    return *flag ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&leaf))
    return std::to_string(*integer);
  if (const auto* number = std::get_if<double>(&leaf))
    return canonical_number(*number);
  if (const auto* text = std::get_if<std::string>(&leaf))
    return *text;
  std::string list;
  for (const double number : std::get<std::vector<double>>(leaf))
    list += (list.empty() ? "" : " × ") + canonical_number(number);
  return list;
}

/// The stated parameters of a root that apply, as "path value, …".
template <class Root>
std::string parameters_in_words(std::span<const Parameter<Root>> table, const Root& root) {
  std::string words;
  for (const auto& row : table) {
    if (!row.applies(root))
      continue;
    if (const JsonLeaf leaf = row.get(root); !is_unstated(leaf))
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", row.path, in_words(leaf));
  }
  return words;
}

const Metric* find_metric(const Plan& plan, MetricName name) {
  for (const Metric& metric : plan.metrics) {
    if (metric.name == name)
      return &metric;
  }
  return nullptr;
}

Note lines_note(const NotesInput& input) {
  std::string text =
      "\"this run\": mean ± sample standard deviation over the n replicates that ended ok, no standard deviation for "
      "n = 1. \"paper\": the figure as printed in " +
      std::string(kPaperCitation) +
      ". \"difference\": this run minus paper, with the digits that both have, for counts also in per cent of the "
      "paper's; for the time the factor paper / this run, above 1 where this run is faster. The paper's rows of "
      "methods "
      "that were not run are left out.";
  for (const RunGroup& group : input.groups) {
    if (group.ok_count() == 0)
      continue;
    const Likeness like = likeness(group.job().scene, input.paper);
    if (!input.paper.find(group.label))
      text += fmt::format(" {}: the paper has no such method.", group.heading);
    else if (like == Likeness::other_powder)
      text += fmt::format(" {}: not the paper's powder, so not compared.", group.heading);
    else if (like == Likeness::other_size)
      text += fmt::format(" {}: the paper's powder in another box than its {} µm, so only ⟨phi_paper⟩ is compared.",
                          group.heading, canonical_number(input.paper.edge_um));
  }
  return {"Lines", text};
}

Note columns_note(const NotesInput& input) {
  const bool two = input.paper.dimension == 2;
  std::string text = fmt::format("⟨X⟩: edge of the box. ⟨N_part⟩: particles in it. ⟨H_N⟩, ⟨{}⟩: Hellinger distance of "
                                 "the radii's histogram to the prescribed law, weighted by number and by {}",
                                 two ? "H_S" : "H_V", two ? "surface (r²)" : "volume (r³)");
  if (const Metric* hellinger = find_metric(input.plan, MetricName::hellinger))
    text += fmt::format(", with ⟨K⟩ = {} equal bins over the law's range of radii", hellinger->bins);
  text += fmt::format("; ⟨H_N_floor⟩, ⟨{}⟩: root mean square of it over perfect random samplers with as many particles "
                      "and the same bins.",
                      two ? "H_S_floor" : "H_V_floor");
  if (const Metric* metric = find_metric(input.plan, MetricName::phi_paper))
    text +=
        fmt::format(" ⟨phi_paper⟩: the paper's estimator, in the sub-box cut {} % of the bounding box of the centres "
                    "(along periodic axes: of the box) from each side: particles whose centre is inside, less the caps "
                    "that stick out; ⟨N_PB⟩: their number.",
                    canonical_number(100 * metric->inset));
  if (const Metric* metric = find_metric(input.plan, MetricName::phi))
    text += fmt::format(" ⟨phi⟩: exact {} of all particles inside the sub-box (inset {} %).", two ? "area" : "volume",
                        canonical_number(100 * metric->inset));
  text +=
      " ⟨overlap_max⟩: deepest overlap of two particles, or of one with a wall, relative to the smaller radius, in the "
      "worst replicate. ⟨stable_alone⟩: share of the particles in equilibrium under their weight with their "
      "neighbours held, in the worst replicate; 1 means all. ⟨z⟩: mean number of contacts of a particle with others, "
      "walls not counted.";
  if (const Metric* metric = find_metric(input.plan, MetricName::coordination))
    text +=
        fmt::format(" A contact is a gap of at most {} of the smaller radius.", canonical_number(metric->contact_gap));
  return {"Columns", text};
}

Note time_note(const NotesInput& input) {
  std::string text = "Wall-clock time of the generator alone, without starting the process, writing or measuring.";
  for (const RunGroup& group : input.groups) {
    const GroupTime time = group_time(group);
    if (time.seconds.n == 0)
      continue;
    std::set<std::string> processors;
    for (const Run& run : group.runs) {
      if (run.ok() && run.generation->timing.mode == time.mode)
        processors.insert(run.generation->provenance.cpu_model);
    }
    text += fmt::format(" {}: timing mode {} ({})", group.heading, name_of(time.mode),
                        time.mode == TimingMode::exclusive ? "alone on the machine, on one pinned thread"
                                                           : "other jobs ran beside it");
    if (time.seconds.n < group.ok_count())
      text +=
          fmt::format(", {} of the {} replicates, as the others ran in shared mode", time.seconds.n, group.ok_count());
    text += fmt::format(", on {}.", fmt::join(processors, " and "));
  }
  text += fmt::format(" The paper: one job after the other on one core of an {}; the factor is between different "
                      "machines.",
                      kPaperMachine);
  return {"Time", text};
}

std::string effects_in_words(const RunGroup& group) {
  for (const Run& run : group.runs) {
    if (!run.ok())
      continue;
    std::string text;
    const Effects& effects = run.generation->effects;
    if (!effects.simulated.empty())
      text += fmt::format("; simulated: {}", fmt::join(effects.simulated, ", "));
    for (std::size_t i = 0; i < effects.left_out.size(); ++i)
      text +=
          fmt::format("{}{} ({})", i == 0 ? "; left out: " : ", ", effects.left_out[i].effect, effects.left_out[i].why);
    return text;
  }
  return {};
}

Note runs_note(const NotesInput& input) {
  std::string text;
  for (const RunGroup& group : input.groups) {
    const Job& job = group.job();
    text += fmt::format("{}{}: {} (revision {}); scene: {}{}.", text.empty() ? "" : " ", group.heading,
                        parameters_in_words(method_parameters(), job.method), info(job.method.name).revision,
                        parameters_in_words(scene_parameters(), job.scene), effects_in_words(group));
  }
  return {"What was run", text};
}

} // namespace

std::vector<Note> estimator_notes(const NotesInput& input) {
  if (input.groups.empty())
    return {};
  return {lines_note(input), columns_note(input), time_note(input), runs_note(input)};
}

std::vector<Note> all_notes(const NotesInput& input) {
  std::vector<Note> notes;
  for (const auto part : {estimator_notes, protocol_notes, outcome_notes, provenance_notes}) {
    std::vector<Note> more = part(input);
    notes.insert(notes.end(), more.begin(), more.end());
  }
  return notes;
}

} // namespace tamp
