// Remaining time as work left divided by the machine.
#include "campaigns/cli/estimate.h"

#include <fmt/format.h>

#include <cmath>

namespace tamp::cli {

Estimate::Estimate(const Agenda& agenda, int cores) : agenda_(agenda) {
  for (const Item& item : agenda.items) {
    Group& group = group_of(item);
    group.left += item.standing == Standing::open ? 1U : 0U;
    group.generation = item.kind == JobKind::generation;
    const bool alone = group.generation && agenda.task(item).run.timing == TimingMode::exclusive;
    group.share = alone ? 1.0 : 1.0 / cores;
  }
}

Estimate::Group& Estimate::group_of(const Item& item) {
  const bool generation = item.kind == JobKind::generation;
  return groups_[generation ? "generation " + agenda_.task(item).planned.label
                            : "metric " + std::string(name_of(agenda_.metric(item).name))];
}

void Estimate::finished(const Item& item, double wall_s) {
  known(item, wall_s);
  --group_of(item).left;
}

void Estimate::known(const Item& item, double wall_s) {
  Group& group = group_of(item);
  ++group.ended;
  group.wall_s += wall_s;
}

void Estimate::barred(const Item& item) {
  --group_of(item).left;
}

std::optional<double> Estimate::remaining_s() const {
  Group all;
  bool generations_left = false;
  bool generations_known = false;
  for (const auto& [name, group] : groups_) {
    all.ended += group.ended;
    all.wall_s += group.wall_s;
    generations_left = generations_left || (group.generation && group.left > 0);
    generations_known = generations_known || (group.generation && group.ended > 0);
  }
  if (all.ended == 0 || (generations_left && !generations_known))
    return std::nullopt;
  double seconds = 0;
  for (const auto& [name, group] : groups_) {
    const Group& like = group.ended > 0 ? group : all;
    seconds += static_cast<double>(group.left) * group.share * like.wall_s / static_cast<double>(like.ended);
  }
  return seconds;
}

std::string in_words(double seconds) {
  constexpr double kMinute = 60;
  constexpr double kHour = 60 * kMinute;
  if (seconds < 1.5 * kMinute)
    return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds < kHour)
    return fmt::format("{:.0f} min", seconds / kMinute);
  const double hours = std::floor(seconds / kHour);
  return fmt::format("{:.0f} h {:.0f} min", hours, std::floor((seconds - hours * kHour) / kMinute));
}

} // namespace tamp::cli
