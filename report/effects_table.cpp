// Makes the table of effects.
#include "report/effects_table.h"

#include "report/cells.h"
#include "report/t_test.h"

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace tamp {

namespace {

/// Effects that a column shows, by the word with which records name them.
constexpr std::array<std::string_view, 7> kShown = {"gravity",  "inertia",  "damping",           "friction",
                                                    "rotation", "adhesion", "rolling resistance"};

const Effects* effects_of(const RunGroup& group) {
  const auto ran = std::find_if(group.runs.begin(), group.runs.end(), [](const Run& run) { return run.ok(); });
  return ran == group.runs.end() ? nullptr : &ran->generation->effects;
}

/// "yes", "no", or nothing where the method does not say.
std::string shown(const Effects& effects, std::string_view effect) {
  const bool out = std::any_of(effects.left_out.begin(), effects.left_out.end(),
                               [&](const Effects::LeftOut& one) { return one.effect == effect; });
  if (out)
    return "no";
  const bool in = std::any_of(effects.simulated.begin(), effects.simulated.end(),
                              [&](const std::string& one) { return one.find(effect) != std::string::npos; });
  return in ? "yes" : "";
}

Panel ledger(std::span<const RunGroup> groups) {
  Panel panel{"Effects simulated", {}, {}};
  for (const std::string_view effect : kShown)
    panel.columns.push_back({std::string(effect), "1", ""});
  std::vector<std::pair<std::string, std::string>> done; // label and cells: a group that differs in nothing here is one
  for (const RunGroup& group : groups) {
    const Effects* effects = effects_of(group);
    if (!effects || effects->simulated.empty())
      continue;
    Group::Line line;
    std::string content;
    for (const std::string_view effect : kShown) {
      line.cells.push_back(word_cell(shown(*effects, effect)));
      content += line.cells.back().word + ";";
    }
    if (std::find(done.begin(), done.end(), std::pair(group.label, content)) != done.end())
      continue;
    done.emplace_back(group.label, content);
    const Simulate simulate = group.job().method.material.simulate;
    const std::string remark = simulate == Simulate::called_for ? "" : fmt::format(" ({})", name_of(simulate));
    panel.groups.push_back({group.label + remark, {}, {line}});
  }
  drop_empty_columns(panel);
  return panel;
}

/// How much longer the other group's median way takes.
Cell ratio_cell(const RunGroup* longer, const RunGroup& own) {
  Cell cell;
  if (!longer)
    return cell;
  const GroupTime a = way_time(*longer);
  const GroupTime b = way_time(own);
  if (a.mode != b.mode || !(a.seconds.median > 0) || !(b.seconds.median > 0))
    return cell;
  cell.value = a.seconds.median / b.seconds.median;
  cell.style = CellStyle::ratio;
  cell.keys = a.keys;
  cell.quantity = "time over that of the scene's own kernel";
  return cell;
}

/// Difference of the densities, pair by pair where both groups start from the same packings, with its 95 % interval.
Cell density_cell(const RunGroup* other, const RunGroup& own) {
  Cell cell;
  if (!other)
    return cell;
  std::map<std::string, std::array<std::vector<double>, 2>> by_origin;
  std::array<std::vector<double>, 2> all;
  bool paired = true;
  for (const std::size_t side : {0U, 1U}) {
    for (const Run& run : (side == 0 ? own : *other).runs) {
      const auto phi = run.ok() ? density_of(run) : std::nullopt;
      if (!phi)
        continue;
      all[side].push_back(*phi);
      by_origin[run.origin()][side].push_back(*phi);
    }
  }
  std::array<std::vector<double>, 2> pairs;
  for (const auto& [origin, both] : by_origin) {
    paired = paired && both[0].size() == 1 && both[1].size() == 1;
    for (const std::size_t side : {0U, 1U})
      pairs[side].insert(pairs[side].end(), both[side].begin(), both[side].end());
  }
  const auto test = paired ? paired_test(pairs[0], pairs[1]) : welch_test(all[0], all[1]);
  if (!test)
    return cell;
  constexpr double outside = 0.05;
  const boost::math::students_t student(test->freedom);
  cell.value = test->difference;
  cell.spread = boost::math::quantile(boost::math::complement(student, outside / 2)) * test->standard_error;
  cell.sign = true;
  cell.keys = ok_keys(*other);
  return cell;
}

Group saving(const EffectsFamily& family) {
  const RunGroup& own = *family.of(Simulate::called_for);
  Group::Line line{"", {time_cell(way_time(own))}};
  for (const Simulate other : {Simulate::in_time, Simulate::all}) {
    const RunGroup* group = family.of(other);
    line.cells.push_back(group ? time_cell(way_time(*group)) : Cell{});
    line.cells.push_back(ratio_cell(group, own));
    line.cells.push_back(density_cell(group, own));
  }
  return {family.label, {}, {line}};
}

std::string rules_in_words(std::span<const RunGroup> groups) {
  std::string text;
  std::vector<std::string> done;
  for (const RunGroup& group : groups) {
    const Effects* effects = effects_of(group);
    if (!effects || group.job().method.material.simulate != Simulate::called_for ||
        std::find(done.begin(), done.end(), group.label) != done.end())
      continue;
    done.push_back(group.label);
    text +=
        fmt::format("{}{}: simulated {}", text.empty() ? "" : ". ", group.label, fmt::join(effects->simulated, "; "));
    for (std::size_t i = 0; i < effects->left_out.size(); ++i)
      text += fmt::format("{}{} ({})", i == 0 ? "; left out " : "; ", effects->left_out[i].effect,
                          effects->left_out[i].why);
  }
  return text.empty() ? text : text + ".";
}

} // namespace

const RunGroup* EffectsFamily::of(Simulate simulate) const {
  const auto found = std::find_if(groups.begin(), groups.end(), [&](const RunGroup& group) {
    return group.job().method.material.simulate == simulate && group.ok_count() > 0;
  });
  return found == groups.end() ? nullptr : &*found;
}

std::vector<EffectsFamily> effects_families(std::span<const Run> runs) {
  std::vector<EffectsFamily> families;
  std::map<std::string, std::size_t> index;
  for (const RunGroup& group : group_runs(runs)) {
    Job job = group.job();
    job.seed = 0;
    job.replicate = 0;
    job.parent.clear();
    job.method.material.simulate = Simulate::called_for;
    const auto [place, is_new] = index.emplace(group.label + '\n' + canonical(job), families.size());
    if (is_new)
      families.push_back({group.label, {}});
    families[place->second].groups.push_back(group);
  }
  std::erase_if(families, [](const EffectsFamily& family) {
    return family.groups.size() < 2 || !family.of(Simulate::called_for);
  });
  return families;
}

Table effects_table(std::span<const Run> runs) {
  Table table;
  table.name = "effects";
  table.caption = "Effects: what each method simulates of the scene, and what it saves to leave the rest out.";
  const std::vector<RunGroup> groups = group_runs(runs);
  Panel ran = ledger(groups);
  Panel savings{"What leaving out saves",
                {{"time", "", "own"},
                 {"time", "", "in time"},
                 {"ratio", "", "in time / own"},
                 {"phi_difference", "1", "in time"},
                 {"time", "", "all"},
                 {"ratio", "", "all / own"},
                 {"phi_difference", "1", "all"}},
                {}};
  for (const EffectsFamily& family : effects_families(runs))
    savings.groups.push_back(saving(family));
  drop_empty_columns(savings);
  for (Panel* panel : {&ran, &savings}) {
    if (panel->groups.empty())
      continue;
    panel->title = fmt::format("({}) {}", static_cast<char>('a' + table.panels.size()), panel->title);
    table.panels.push_back(std::move(*panel));
  }
  if (table.panels.empty())
    return table;
  table.notes.push_back({"Rules", rules_in_words(groups)});
  if (table.panels.size() > 1)
    table.notes.push_back(
        {"Savings",
         "The same scene by its own kernel, by the same effects with motion followed in time where the own "
         "kernel minimises energy, and by the kernel of all effects with zeros for those that the scene does not "
         "call for. Times are medians of the whole way. ⟨phi_difference⟩: mean difference to the own kernel's "
         "packing fraction with its 95 % interval, pair by pair where both start from the same packings."});
  return table;
}

} // namespace tamp
