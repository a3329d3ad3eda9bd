// Makes the table of what accuracy costs.
#include "report/accuracy_table.h"

#include "report/cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp {

namespace {

/// Times closer than this cannot be told apart on a shared machine.
constexpr double kClearlyFaster = 0.8;
/// Errors closer than this share are the same accuracy.
constexpr double kClearlyBetter = 0.8;

/// Errors that a user may ask for, relative.
constexpr std::array kWanted = {0.01, 0.003, 0.001};

std::string value_words(const KnobFamily& family, std::size_t level) {
  return fmt::format("{}", family.levels[level].value);
}

std::string knob_name(const KnobFamily& family) {
  return std::string(family.knob->path.substr(family.knob->path.find('/') + 1));
}

std::string family_name(const KnobFamily& family) {
  return family.label + ": " + knob_name(family);
}

Cell error_cell(const Estimate& estimate, const RunGroup& group, double scale, std::string_view unit) {
  Cell cell;
  if (!std::isfinite(estimate.value))
    return cell;
  cell.value = estimate.value * scale;
  cell.spread = estimate.half_width * scale;
  cell.sign = true;
  cell.unit = unit;
  cell.keys = ok_keys(group);
  return cell;
}

Cell plain(double value, std::optional<int> decimals = {}) {
  Cell cell;
  cell.value = value;
  cell.decimals = decimals;
  return cell;
}

/// The error of a method that is not measured against other levels but left in the packing itself.
Cell left_cell(const RunGroup& group, std::string_view measure) {
  return quantity_cell(group, {measure, CellStyle::scientific, 2});
}

/// Effects of a family on what the table shows of it.
struct FamilyEffects {
  std::optional<KnobEffect> phi;
  std::optional<KnobEffect> z;
  std::optional<KnobEffect> h;
};

FamilyEffects effects_of(const KnobFamily& family) {
  const bool two = family.levels.front().group.job().scene.dimension == 2;
  return {knob_effect(family, "phi"), knob_effect(family, "z"), knob_effect(family, two ? "H_S" : "H_V")};
}

Summary densities(const RunGroup& group) {
  std::vector<double> values;
  for (const Run& run : group.runs) {
    if (const auto phi = run.ok() ? density_of(run) : std::nullopt)
      values.push_back(*phi);
  }
  return summarize(values);
}

const std::vector<Column> kLevelColumns = {{"n", "1", ""},         {"N_part", "1", ""},      {"phi", "1", ""},
                                           {"phi_error", "%", ""}, {"phi_scatter", "%", ""}, {"z_error", "1", ""},
                                           {"H_error", "1", ""},   {"overlap_max", "1", ""}, {"force_balance", "1", ""},
                                           {"time", "", ""}};

Group level_group(const KnobFamily& family, std::size_t i, const FamilyEffects& effects) {
  const KnobLevel& level = family.levels[i];
  const RunGroup& group = level.group;
  Group::Line line{"", {count_cell(static_cast<double>(group.ok_count()))}};
  const std::string name =
      fmt::format("{} = {}{}", family_name(family), value_words(family, i), level.is_default ? " (default)" : "");
  if (group.ok_count() == 0) {
    line.cells.push_back(word_cell(other_outcomes(group)));
    line.cells.resize(kLevelColumns.size());
    return {name, {}, {line}};
  }
  const Summary phi = densities(group);
  Cell density = plain(phi.mean, 4);
  density.spread = phi.sd;
  density.n = phi.n;
  density.keys = ok_keys(group);
  line.cells.push_back(quantity_cell(group, {"N_part", CellStyle::fixed, 0}));
  line.cells.push_back(density);
  const auto error = [&](const std::optional<KnobEffect>& effect, double scale, std::string_view unit) {
    return effect ? error_cell(effect->error[i], group, scale, unit) : Cell{};
  };
  line.cells.push_back(error(effects.phi, effects.phi ? 100 / effects.phi->reference : 0, "%"));
  line.cells.push_back(plain(100 * phi.sd / phi.mean, 2));
  line.cells.push_back(error(effects.z, 1, "1"));
  line.cells.push_back(error(effects.h, 1, "1"));
  line.cells.push_back(left_cell(group, "overlap_max"));
  line.cells.push_back(left_cell(group, "force_balance"));
  line.cells.push_back(time_cell(way_time(group)));
  return {name, {}, {line}};
}

const std::vector<Column> kKnobColumns = {
    {"phi_reference", "1", ""}, {"order", "1", ""},       {"default", "1", ""}, {"phi_error_at_most", "%", "default"},
    {"time", "", "default"},    {"on the front", "", ""}, {"for 1 %", "", ""},  {"for 0.3 %", "", ""},
    {"for 0.1 %", "", ""}};

std::string time_words(double seconds) {
  const CellText text = show(time_cell(seconds));
  return text.value + " " + text.unit;
}

std::string setting_words(const Setting& setting) {
  return fmt::format("{} ({})", value_words(*setting.family, setting.level), time_words(setting.seconds));
}

Group knob_group(const KnobFamily& family, const FamilyEffects& effects, std::span<const Setting> all) {
  Group::Line line;
  const auto& phi = effects.phi;
  Cell reference;
  if (phi) {
    reference = plain(phi->reference, 4);
    if (phi->order.found())
      reference.spread = phi->order.limit_error;
  }
  line.cells.push_back(reference);
  if (phi && phi->order.found())
    line.cells.push_back(word_cell(
        fmt::format("{:.2f} [{:.2f}, {:.2f}]", phi->order.order, phi->order.order_low, phi->order.order_high)));
  else
    line.cells.push_back(word_cell(phi ? phi->order.why_none : "not measured"));
  std::vector<Setting> own;
  const Setting* standard = nullptr;
  for (const Setting& setting : all) {
    if (setting.family == &family)
      own.push_back(setting);
  }
  for (const Setting& setting : own) {
    if (family.levels[setting.level].is_default)
      standard = &setting;
  }
  if (standard) {
    const auto rival = std::find_if(own.begin(), own.end(), [&](const Setting& s) { return standard->beaten_by(s); });
    line.cells.push_back(plain(family.levels[standard->level].value));
    line.cells.push_back(plain(100 * standard->error, 2));
    line.cells.push_back(time_cell(way_time(family.levels[standard->level].group)));
    line.cells.push_back(word_cell(rival == own.end() ? "yes" : "no: " + setting_words(*rival)));
  } else {
    line.cells.resize(line.cells.size() + 4);
  }
  for (const double share : kWanted) {
    const Setting* found = cheapest(own, share);
    line.cells.push_back(word_cell(found ? setting_words(*found) : "none shown"));
  }
  return {family_name(family), {}, {line}};
}

Note columns_note() {
  return {"Columns",
          "One knob is turned at a time, all others stand at the values of the method's row. ⟨phi⟩: mean ± sample "
          "standard deviation over the n replicates that ended ok, of the whole box where it is periodic all round, "
          "else of the central sub-box. ⟨phi_error⟩: distance of the mean from ⟨phi_reference⟩, ± the 95 % interval "
          "of that distance, which holds the systematic error of the setting; ⟨phi_scatter⟩: by how much one packing "
          "of this size differs from the next. ⟨z_error⟩ and ⟨H_error⟩: the same distance of the coordination number "
          "and of the Hellinger distance by volume (2D: surface), in their own units. ⟨overlap_max⟩ and "
          "⟨force_balance⟩ (rms net force of a particle over the mean contact force) are errors themselves. The time "
          "is the median of the whole way from the scene."};
}

Note order_note() {
  return {"Order and reference",
          fmt::format(
              "⟨order⟩: ⟨phi⟩ = ⟨phi_reference⟩ + C h^⟨order⟩ by weighted least squares, with its 95 % interval; h is "
              "the value of the knob, or one over it where larger is finer. At least {} levels, and a change "
              "beyond the scatter, are asked for; else ⟨phi_reference⟩ is the mean of the finest level. Where "
              "all levels start from the same packings, what a replicate has in common at all levels is taken "
              "out first.",
              kFewestForOrder)};
}

Note front_note() {
  return {"Front",
          fmt::format("⟨phi_error_at_most⟩: |distance| and its interval together, so that scatter counts as error. A "
                      "default is on the front of its knob unless another level takes less than {:.0f} % of the time "
                      "and is no less exact, or no more time and has less than {:.0f} % of the error. \"for 1 %\": the "
                      "fastest level known to be so exact, with its time; \"none shown\": more replicates or larger "
                      "packings would be needed to know.",
                      100 * kClearlyFaster, 100 * kClearlyBetter)};
}

} // namespace

bool Setting::beaten_by(const Setting& other) const {
  return (other.seconds < kClearlyFaster * seconds && other.error <= error) ||
         (other.seconds <= seconds && other.error < kClearlyBetter * error);
}

std::vector<Setting> settings_of(std::span<const KnobFamily> families) {
  std::vector<Setting> settings;
  for (const KnobFamily& family : families) {
    const auto effect = knob_effect(family, "phi");
    if (!effect)
      continue;
    for (std::size_t i = 0; i < family.levels.size(); ++i) {
      const double seconds = way_time(family.levels[i].group).seconds.median;
      const double error = effect->error[i].bound() / effect->reference;
      if (seconds > 0 && std::isfinite(error))
        settings.push_back({&family, i, seconds, error});
    }
  }
  return settings;
}

std::vector<Setting> front_of(std::span<const Setting> settings) {
  std::vector<Setting> order(settings.begin(), settings.end());
  std::stable_sort(order.begin(), order.end(), [](const Setting& a, const Setting& b) {
    return std::pair(a.seconds, a.error) < std::pair(b.seconds, b.error);
  });
  std::vector<Setting> front;
  for (const Setting& setting : order) {
    if (front.empty() || setting.error < front.back().error)
      front.push_back(setting);
  }
  return front;
}

const Setting* cheapest(std::span<const Setting> settings, double share) {
  const Setting* best = nullptr;
  for (const Setting& setting : settings) {
    if (setting.error <= share && (!best || setting.seconds < best->seconds))
      best = &setting;
  }
  return best;
}

Table accuracy_table(std::span<const KnobFamily> families) {
  Table table;
  table.name = "accuracy";
  table.caption = "What accuracy costs: error of the packing fraction, of the coordination number and of the size "
                  "distribution, and time, over each accuracy knob of each method.";
  if (families.empty())
    return table;
  const std::vector<Setting> settings = settings_of(families);
  Panel levels{"(a) Levels", kLevelColumns, {}, "Setting"};
  Panel knobs{"(b) Knobs: order of convergence, place of the default, cheapest settings", kKnobColumns, {}, "Knob"};
  for (const KnobFamily& family : families) {
    const FamilyEffects effects = effects_of(family);
    for (std::size_t i = 0; i < family.levels.size(); ++i) {
      if (family.levels[i].group.ok_count() > 0 || !other_outcomes(family.levels[i].group).empty())
        levels.groups.push_back(level_group(family, i, effects));
    }
    if (effects.phi)
      knobs.groups.push_back(knob_group(family, effects, settings));
  }
  for (Panel* panel : {&levels, &knobs}) {
    drop_empty_columns(*panel);
    if (!panel->groups.empty())
      table.panels.push_back(std::move(*panel));
  }
  if (!table.panels.empty())
    table.notes = {columns_note(), order_note(), front_note()};
  return table;
}

} // namespace tamp
