// Wall time against CPU time, and the hypervisor's own account.
#include "engine/schedule/disturbance.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace tamp {

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

} // namespace

std::string disturbance(double wall_s, double cpu_s, double steal_s) {
  if (steal_s > std::max(kStolenShare * wall_s, kWaitedLeast_s))
    return fmt::format("the hypervisor took {:.2g} s of {:.3g} s", steal_s, wall_s);
  const double waited = wall_s - cpu_s;
  if (waited > std::max(kWaitedShare * wall_s, kWaitedLeast_s))
    return fmt::format("off its core for {:.2g} s of {:.3g} s", waited, wall_s);
  return {};
}

void settle_time(Timing& timing) {
  const bool alone = timing.mode == TimingMode::exclusive; // of shared times nothing is expected
  std::string& disturbed = timing.conditions.disturbed;
  if (timing.samples.empty()) {
    disturbed = alone ? disturbance(timing.wall_s, timing.cpu_s, timing.conditions.steal_s) : "";
    return;
  }
  for (TimeSample& sample : timing.samples)
    sample.disturbed = alone ? disturbance(sample.wall_s, sample.cpu_s, sample.steal_s) : "";
  const auto quiet = [](const TimeSample& sample) { return sample.disturbed.empty(); };
  const bool any_quiet = std::any_of(timing.samples.begin(), timing.samples.end(), quiet);
  disturbed = any_quiet ? "" : "each time that it ran; the first time " + timing.samples.front().disturbed;
  std::vector<double> wall;
  std::vector<double> cpu;
  for (const TimeSample& sample : timing.samples) {
    if (any_quiet && !quiet(sample))
      continue;
    wall.push_back(sample.wall_s);
    cpu.push_back(sample.cpu_s);
  }
  timing.wall_s = median(std::move(wall));
  timing.cpu_s = median(std::move(cpu));
}

} // namespace tamp
