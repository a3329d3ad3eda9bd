// Finds families by neutralising one knob after the other; errors by least squares over levels and replicates.
#include "report/knob_families.h"

#include "engine/model/parameter.h"
#include "report/quantities.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace tamp {

namespace {

/// Outside the 95 % interval.
constexpr double kOutside = 0.05;
/// A scatter below this share of the mean is that of sums in another order.
constexpr double kRounding = 1e-12;

double as_number(const JsonLeaf& leaf) {
  if (const auto* whole = std::get_if<std::int64_t>(&leaf))
    return static_cast<double>(*whole);
  const auto* number = std::get_if<double>(&leaf);
  return number ? *number : ConvergenceOrder::kNone;
}

/// A parameter of a scene or method, found by its path.
template <class Root>
const Parameter<Root>* find_row(std::span<const Parameter<Root>> table, std::string_view path) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.path == path; });
  return found == table.end() ? nullptr : &*found;
}

/// The knob of a job: its value, that of a job where it is not stated, and the job without it.
struct Turned {
  double value;
  double unstated;
  Job neutral;
};

template <class Root>
std::optional<Turned> turned(const Job& job, Root Job::*root, std::span<const Parameter<Root>> table,
                             std::string_view path, const Root& unstated) {
  const Parameter<Root>* row = find_row(table, path);
  if (!row || !row->applies(job.*root))
    return std::nullopt;
  Turned found{as_number(row->get(job.*root)), as_number(row->get(unstated)), job};
  if (!std::isfinite(found.value) || found.value <= 0)
    return std::nullopt;
  row->set(found.neutral.*root, row->kind == ParameterKind::integer ? JsonLeaf(std::int64_t{1}) : JsonLeaf(1.0));
  return found;
}

std::optional<Turned> turned(const Job& job, const AccuracyKnob& knob) {
  const std::size_t slash = knob.path.find('/');
  const std::string_view below = knob.path.substr(slash + 1);
  if (knob.path.substr(0, slash) == "scene") {
    auto found = turned(job, &Job::scene, scene_parameters(), below, Scene{});
    if (found)
      found->neutral.scene.size = {1}; // more particles need a larger box
    return found;
  }
  Method unstated;
  unstated.name = job.method.name;
  return turned(job, &Job::method, method_parameters(), below, unstated);
}

/// Values of a quantity: one row for each level, one column for each replicate where the levels are paired.
struct Samples {
  std::vector<std::vector<double>> of_level;
  bool paired = false;
};

std::optional<double> value_of(const Run& run, const std::string& quantity) {
  return quantity == "phi" ? density_of(run) : run.measure(quantity);
}

Samples samples_of(const KnobFamily& family, const std::string& quantity) {
  std::vector<std::map<std::string, double>> by_origin;
  Samples samples;
  samples.paired = true;
  for (const KnobLevel& level : family.levels) {
    std::map<std::string, double> values;
    samples.of_level.emplace_back();
    for (const Run& run : level.group.runs) {
      const auto value = run.ok() ? value_of(run, quantity) : std::nullopt;
      if (!value)
        continue;
      samples.of_level.back().push_back(*value);
      samples.paired = samples.paired && !run.way.empty() && values.emplace(run.origin(), *value).second;
    }
    by_origin.push_back(std::move(values));
  }
  if (!samples.paired)
    return samples;
  std::map<std::string, std::pair<std::size_t, double>> sums; // of a replicate: levels that have it, sum of values
  std::size_t present = 0;
  for (const auto& values : by_origin) {
    present += values.empty() ? 0U : 1U;
    for (const auto& [origin, value] : values) {
      ++sums[origin].first;
      sums[origin].second += value;
    }
  }
  double mean = 0;
  std::size_t complete = 0;
  for (const auto& [origin, sum] : sums) {
    if (sum.first == present) {
      mean += sum.second / static_cast<double>(present);
      ++complete;
    }
  }
  if (complete < 2) {
    samples.paired = false;
    return samples;
  }
  mean /= static_cast<double>(complete);
  // What a replicate has in common at all levels is no effect of the knob.
  for (std::size_t i = 0; i < by_origin.size(); ++i) {
    samples.of_level[i].clear();
    for (const auto& [origin, value] : by_origin[i]) {
      if (sums[origin].first == present)
        samples.of_level[i].push_back(value - sums[origin].second / static_cast<double>(present) + mean);
    }
  }
  return samples;
}

} // namespace

double Estimate::bound() const {
  return std::abs(value) + half_width;
}

std::vector<KnobFamily> knob_families(std::span<const Run> runs) {
  std::vector<KnobFamily> families;
  const std::vector<RunGroup> groups = group_runs(runs);
  std::vector<std::string> labels;
  for (const RunGroup& group : groups) {
    if (std::find(labels.begin(), labels.end(), group.label) == labels.end())
      labels.push_back(group.label);
  }
  for (const std::string& label : labels) {
    for (const AccuracyKnob& knob : kAccuracyKnobs) {
      std::vector<std::string> order;
      std::map<std::string, KnobFamily> found;
      for (const RunGroup& group : groups) {
        auto job = group.label == label ? turned(group.job(), knob) : std::nullopt;
        if (!job)
          continue;
        job->neutral.seed = 0;
        job->neutral.replicate = 0;
        job->neutral.parent.clear();
        const std::string content = canonical(job->neutral);
        if (found.count(content) == 0)
          order.push_back(content);
        KnobFamily& family = found[content];
        family.label = label;
        family.knob = &knob;
        family.levels.push_back({group, job->value, job->value == job->unstated});
      }
      for (const std::string& content : order) {
        KnobFamily& family = found[content];
        std::stable_sort(family.levels.begin(), family.levels.end(), [&](const KnobLevel& a, const KnobLevel& b) {
          return knob.step(a.value) > knob.step(b.value);
        });
        if (family.levels.size() >= kFewestLevels)
          families.push_back(std::move(family));
      }
    }
  }
  return families;
}

std::optional<KnobEffect> knob_effect(const KnobFamily& family, const std::string& quantity) {
  const Samples samples = samples_of(family, quantity);
  std::vector<Summary> summaries;
  double variance = 0; // of one replicate, pooled over levels; first the sum of squares
  double freedom = 0;
  std::size_t present = 0;
  for (const std::vector<double>& values : samples.of_level) {
    summaries.push_back(summarize(values));
    if (values.size() < 2)
      continue;
    const auto free = static_cast<double>(values.size() - 1);
    variance += free * summaries.back().sd * summaries.back().sd;
    freedom += free;
    ++present;
  }
  if (present < kFewestLevels)
    return std::nullopt;
  // To take out what replicates have in common costs a degree of freedom each.
  if (samples.paired)
    freedom *= 1 - 1 / static_cast<double>(present);
  variance /= freedom;
  // More particles scatter less: there each level answers for itself.
  const bool pooled = family.knob->path != "scene/count";
  const auto error_of = [&](const Summary& s) {
    const double error = std::sqrt((pooled ? variance : s.sd * s.sd) / static_cast<double>(s.n));
    return error > kRounding * std::abs(s.mean) ? error : 0;
  };
  std::vector<OrderPoint> points;
  std::optional<std::size_t> finest;
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    if (summaries[i].n < 2)
      continue;
    finest = i;
    if (const double error = error_of(summaries[i]); error > 0)
      points.push_back({family.knob->step(family.levels[i].value), summaries[i].mean, error});
  }
  KnobEffect effect;
  effect.quantity = quantity;
  effect.paired = samples.paired;
  effect.order = convergence_order(points);
  const Summary& best = summaries[*finest];
  effect.reference = effect.order.found() ? effect.order.limit : best.mean;
  const double reference_error = effect.order.found() ? effect.order.limit_error : error_of(best);
  const double reach = boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), kOutside / 2));
  for (const Summary& summary : summaries) {
    if (summary.n < 2) {
      effect.error.emplace_back();
      continue;
    }
    effect.error.push_back({summary.mean - effect.reference, reach * std::hypot(error_of(summary), reference_error)});
  }
  return effect;
}

} // namespace tamp
