// Tasks of one generation (distance from the first ancestor that is to run) and one budget share arrays.
#include "engine/schedule/slurm_arrays.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>

namespace tamp {

namespace {

/// Order of the generations first, so that an array stands behind those it waits for.
using Class = std::tuple<std::size_t, double, double, std::int64_t, TimingMode, std::int64_t>;

Class class_of(std::size_t generation, const RunSettings& run) {
  return {generation, run.wall_s, run.cpu_s, run.memory_mb, run.timing, run.samples};
}

std::size_t tasks_in_element(const RunSettings& run, const ClusterProfile& profile) {
  const double fitting = profile.bundle_wall_s / run.wall_s;
  const auto most = static_cast<std::size_t>(profile.bundle_jobs);
  return fitting >= static_cast<double>(most) ? most : std::max<std::size_t>(1, static_cast<std::size_t>(fitting));
}

} // namespace

std::size_t ClusterArray::longest() const {
  std::size_t most = 0;
  for (const auto& element : elements)
    most = std::max(most, element.size());
  return most;
}

std::vector<ClusterArray> arrange(const Agenda& agenda, std::span<const std::size_t> tasks,
                                  const ClusterProfile& profile, std::size_t largest) {
  std::unordered_map<std::string, std::size_t> generation; // of each key that is to run
  std::map<Class, std::vector<std::size_t>> classes;
  for (const std::size_t t : tasks) {
    const Task& task = agenda.tasks[t];
    const auto parent = generation.find(task.planned.job.parent);
    const std::size_t own = parent == generation.end() ? 0 : parent->second + 1;
    generation.emplace(task.planned.key, own);
    classes[class_of(own, task.run)].push_back(t);
  }

  largest = std::max<std::size_t>(1, std::min(largest, static_cast<std::size_t>(profile.array_size)));
  std::vector<ClusterArray> arrays;
  std::unordered_map<std::string, std::size_t> array_of;
  for (const auto& [kind, members] : classes) {
    const RunSettings& run = agenda.tasks[members.front()].run;
    const std::size_t bundle = tasks_in_element(run, profile);
    for (std::size_t begin = 0; begin < members.size(); begin += bundle * largest) {
      ClusterArray array{.run = run, .elements = {}, .after = {}};
      const std::size_t end = std::min(members.size(), begin + bundle * largest);
      std::set<std::size_t> after;
      for (std::size_t m = begin; m < end; ++m) {
        if ((m - begin) % bundle == 0)
          array.elements.emplace_back();
        array.elements.back().push_back(members[m]);
        const PlannedJob& planned = agenda.tasks[members[m]].planned;
        array_of.emplace(planned.key, arrays.size());
        if (const auto parent = array_of.find(planned.job.parent); parent != array_of.end())
          after.insert(parent->second);
      }
      array.after.assign(after.begin(), after.end());
      arrays.push_back(std::move(array));
    }
  }
  return arrays;
}

} // namespace tamp
