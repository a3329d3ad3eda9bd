// Notes on times and on what was run; and all notes together.
#include "engine/model/parameter.h"
#include "report/cells.h"
#include "report/density_oracle.h"
#include "report/notes.h"
#include "report/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
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

/// Up to this many groups of one method, a parameter that varies is listed for each; above, its different values.
constexpr std::size_t kListedGroups = 12;

/// What a parameter is in each of the groups, "" where it does not apply: once if it is the same in all.
std::string values_in_words(const std::vector<std::string>& values) {
  const std::set<std::string> different(values.begin(), values.end());
  if (different.size() == 1)
    return values.front();
  if (values.size() <= kListedGroups)
    return fmt::format("{}", fmt::join(values, " | "));
  std::vector<std::string> in_order;
  for (const std::string& value : values) {
    if (!value.empty() && std::find(in_order.begin(), in_order.end(), value) == in_order.end())
      in_order.push_back(value);
  }
  return fmt::format("{}", fmt::join(in_order, " | "));
}

/// The stated parameters that apply to any of the roots, as "path value, …".
template <class Root>
std::string parameters_in_words(std::span<const Parameter<Root>> table, const std::vector<const Root*>& roots) {
  std::string words;
  for (const auto& row : table) {
    std::vector<std::string> values;
    for (const Root* root : roots) {
      const JsonLeaf leaf = row.applies(*root) ? row.get(*root) : JsonLeaf(std::vector<double>{});
      values.push_back(is_unstated(leaf) ? "" : in_words(leaf));
    }
    if (const std::string text = values_in_words(values); !text.empty())
      words += fmt::format("{}{} {}", words.empty() ? "" : ", ", row.path, text);
  }
  return words;
}

/// How the times of one group were taken.
std::string timing_in_words(const RunGroup& group, const GroupTime& time) {
  std::set<std::string> processors;
  for (const Run& run : group.runs) {
    if (run.ok() && run.generation->timing.counts_as(time.mode))
      processors.insert(run.generation->provenance.cpu_model);
  }
  std::string text =
      fmt::format("timing mode {} ({})", name_of(time.mode),
                  time.mode == TimingMode::exclusive ? "no other job of the store beside it, on one pinned thread"
                                                     : "other jobs ran beside it");
  if (time.seconds.n + time.disturbed < group.ok_count())
    text +=
        fmt::format(", {} of the {} replicates, as the others ran in shared mode", time.seconds.n, group.ok_count());
  if (time.samples > 0)
    text += fmt::format(", each time the median of several runs in turn ({} in all, {} of them left out as disturbed)",
                        time.samples, time.disturbed_samples);
  if (time.disturbed > 0)
    text += fmt::format(", {} disturbed times left out", time.disturbed);
  return text + fmt::format(", on {}", fmt::join(processors, " and "));
}

std::string duration_in_words(const GroupTime& time) {
  const CellText shown = show(time_cell(time));
  return shown.value + (shown.spread.empty() ? "" : " ± " + shown.spread) + " " + shown.unit;
}

Note time_note(const NotesInput& input) {
  std::string text =
      "Wall-clock time of the generator alone, without starting the process, writing or measuring: median over the "
      "replicates ± standard deviation.";
  std::vector<std::pair<std::string, std::vector<std::string>>> ways; // each with the groups timed in that way
  std::string intervals;
  for (const RunGroup& group : input.groups) {
    const GroupTime time = group_time(group);
    if (time.seconds.n == 0)
      continue;
    const std::string way = timing_in_words(group, time);
    auto place = std::find_if(ways.begin(), ways.end(), [&](const auto& known) { return known.first == way; });
    if (place == ways.end())
      place = ways.insert(ways.end(), {way, {}});
    place->second.push_back(group.heading);
    if (time.interval)
      intervals += fmt::format("{}{} {:.3g} to {:.3g} s", intervals.empty() ? "" : "; ", group.heading,
                               time.interval->low, time.interval->high);
  }
  for (const auto& [way, headings] : ways)
    text += fmt::format(" {}: {}.",
                        ways.size() == 1 && headings.size() > 1 ? "All" : fmt::format("{}", fmt::join(headings, "; ")),
                        way);
  if (!intervals.empty())
    text += fmt::format(" 95 % intervals of the medians (Student's t of the logarithms): {}.", intervals);
  bool any_start = false;
  for (const RunGroup& group : input.groups) {
    const std::string start = group.start_in_words();
    if (start.empty() || group.ok_count() == 0)
      continue;
    any_start = true;
    const GroupTime whole = way_time(group);
    text += fmt::format(" {} starts from packings of {}: ", group.heading, start) +
            (whole.seconds.n == 0 ? "the time of the whole way is not known in this mode."
                                  : fmt::format("with theirs {}.", duration_in_words(whole)));
  }
  if (any_start)
    text += " Factors against the paper's time count the whole way.";
  if (input.lognormal)
    text += " " + paper_time_sentence();
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
  std::vector<std::string> labels;
  for (const RunGroup& group : input.groups) {
    if (std::find(labels.begin(), labels.end(), group.label) == labels.end())
      labels.push_back(group.label);
  }
  std::string text;
  for (const std::string& label : labels) {
    std::vector<const Method*> methods;
    std::vector<const Scene*> scenes;
    std::string effects;
    std::string start;
    for (const RunGroup& group : input.groups) {
      if (group.label != label)
        continue;
      methods.push_back(&group.job().method);
      scenes.push_back(&group.job().scene);
      if (effects.empty())
        effects = effects_in_words(group);
      if (start.empty() && !group.runs.front().way.empty())
        start = fmt::format(", started from the packing of the same replicate of {}", group.start_in_words());
    }
    if (is_periodic_all_round(*methods.front()))
      start +=
          ", pressed in a box of its own that is periodic on all sides and not quite as large as the scene's, whose "
          "edge the tables show";
    text += fmt::format("{}{}: {} (revision {}){}; scene: {}{}.", text.empty() ? "" : " ", label,
                        parameters_in_words(method_parameters(), methods), info(methods.front()->name).revision, start,
                        parameters_in_words(scene_parameters(), scenes), effects);
  }
  if (labels.size() < input.groups.size())
    text += " Values with | between them are those of different groups, in their order.";
  const bool other_unit = std::any_of(input.groups.begin(), input.groups.end(),
                                      [](const RunGroup& group) { return group.job().scene.unit != LengthUnit::um; });
  if (other_unit)
    text += " Lengths of a scene are in its own unit here, in µm elsewhere.";
  return {"What was run", text};
}

/// What stands behind ± where there is but one packing.
Note errors_note() {
  return {
      "Error bars",
      "± is the sample standard deviation over replicates. Behind the number of a single packing it is the standard "
      "error within that packing: of ⟨phi⟩ from the scatter of the 27 (2D: 9) equal parts of the sub-box, of ⟨z⟩ "
      "from that of the particles' contact numbers, of ⟨H⟩ that of independent draws (multinomial)."};
}

bool any_single(std::span<const RunGroup> groups) {
  return std::any_of(groups.begin(), groups.end(), [](const RunGroup& group) {
    return group.ok_count() == 1 && std::isfinite(inner_error(group, "phi"));
  });
}

} // namespace

std::string paper_time_sentence() {
  return fmt::format("The paper: one job after the other on one core of an {}; the factor is between different "
                     "machines.",
                     kPaperMachine);
}

std::vector<Note> run_notes(const NotesInput& input) {
  if (input.groups.empty())
    return {};
  std::vector<Note> notes = {time_note(input), runs_note(input)};
  if (const std::string above = above_in_words(input.groups); !above.empty())
    notes.push_back({"Denser than random close packing", above});
  if (any_single(input.groups))
    notes.push_back(errors_note());
  return notes;
}

std::vector<Note> all_notes(const NotesInput& input, std::vector<Note> own) {
  std::vector<Note> notes = std::move(own);
  for (const auto part : {estimator_notes, run_notes, protocol_notes, outcome_notes, provenance_notes}) {
    std::vector<Note> more = part(input);
    notes.insert(notes.end(), more.begin(), more.end());
  }
  return notes;
}

} // namespace tamp
