// Sorts groups into families that differ in size alone, and takes their times.
#include "report/cells.h"
#include "report/domain_size_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tamp {

namespace {

/// What a family has in common.
std::string family_content(const RunGroup& group) {
  Job job = group.job();
  job.seed = 0;
  job.replicate = 0;
  job.parent.clear(); // groups that start from different packings
  job.scene.size = {1};
  job.scene.count = 0;
  for (double* cut : {&job.scene.psd.r_min, &job.scene.psd.r_max}) {
    if (stated(*cut))
      *cut = 1;
  }
  return group.label + '\n' + canonical(job);
}

std::string law_in_words(const Psd& psd) {
  std::string words(name_of(psd.law));
  if (psd.law == Law::bimodal)
    words += fmt::format(" ⟨rho⟩ = {}, ⟨X_L⟩ = {}", psd.size_ratio, psd.large_volume_fraction);
  return words;
}

/// Geometric mean: the mean of points in a plane of logarithms.
double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values)
    sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

} // namespace

double edge_of(const RunGroup& group) {
  const Scene& scene = group.job().scene;
  double content = 1;
  for (const double edge : scene.size)
    content *= edge * micrometres(scene.unit);
  const bool equal =
      std::adjacent_find(scene.size.begin(), scene.size.end(), std::not_equal_to<>{}) == scene.size.end();
  return equal ? scene.size.front() * micrometres(scene.unit)
               : std::pow(content, 1 / static_cast<double>(scene.dimension));
}

std::vector<SizeFamily> size_families(std::span<const Run> runs) {
  std::vector<SizeFamily> families;
  std::map<std::string, std::size_t> index;
  std::map<std::string, int> uses;
  for (const RunGroup& group : group_runs(runs)) {
    const auto [place, is_new] = index.emplace(family_content(group), families.size());
    if (is_new) {
      families.push_back({group.label, {}});
      ++uses[group.label];
    }
    families[place->second].groups.push_back(group);
  }
  for (SizeFamily& family : families) {
    if (uses[family.name] > 1)
      family.name += ", " + law_in_words(family.groups.front().job().scene.psd);
    std::stable_sort(family.groups.begin(), family.groups.end(), [](const RunGroup& a, const RunGroup& b) {
      return std::pair(edge_of(a), a.job().scene.count) < std::pair(edge_of(b), b.job().scene.count);
    });
  }
  return families;
}

TimedPoints timed_points(const SizeFamily& family) {
  TimedPoints found;
  for (const RunGroup& group : family.groups) {
    if (group_time(group).mode == TimingMode::exclusive)
      found.mode = TimingMode::exclusive;
  }
  for (const RunGroup& group : family.groups) {
    std::vector<double> counts;
    std::vector<double> times;
    for (const Run& run : group.runs) {
      const auto count = run.ok() ? run.measure("N") : std::nullopt;
      if (!count || *count <= 0 || run.generation->timing.wall_s <= 0)
        continue;
      if (run.generation->timing.mode != found.mode) {
        ++found.left_out;
        continue;
      }
      if (!run.generation->timing.counts_as(found.mode)) {
        ++found.disturbed;
        continue;
      }
      found.processors.insert(run.generation->provenance.cpu_model);
      counts.push_back(*count);
      times.push_back(run.generation->timing.wall_s);
    }
    found.of_group.push_back(counts.empty() ? std::nullopt : std::optional(found.points.size()));
    if (!counts.empty())
      found.points.push_back({geometric_mean(counts), geometric_mean(times)});
  }
  return found;
}

} // namespace tamp
