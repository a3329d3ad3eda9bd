// Collects records, fits them, and sums over the open jobs.
#include "campaigns/cli/plan_costs.h"

#include "campaigns/cli/learned_cost.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

/// More records of a method or metric would make the answer slow and hardly better.
constexpr std::size_t kMostRecords = 300;
constexpr double kBytesPerMb = 1e6;

using Name = std::pair<JobKind, std::string>;

Name name_of(const Agenda& agenda, const Item& item) {
  const bool generation = item.kind == JobKind::generation;
  return {item.kind, std::string(generation ? tamp::name_of(agenda.task(item).planned.job.method.name)
                                            : tamp::name_of(agenda.metric(item).name))};
}

struct Learned {
  LearnedCost cost;
  bool elsewhere; ///< from records of other CPU models
};

class Teacher {
public:
  explicit Teacher(const Store& store) : store_(store), cpu_model_(host_facts().cpu_model) {}

  Learned learn(const Name& name) {
    std::vector<CostPoint> here;
    std::vector<CostPoint> elsewhere;
    const std::vector<RecordedJob> jobs = store_.recorded_jobs(name.first, name.second);
    for (std::size_t i = jobs.size() - std::min(jobs.size(), kMostRecords); i < jobs.size(); ++i) {
      const std::optional<Record> record = store_.find(jobs[i].key);
      if (!record || !leaves_packing(record->outcome))
        continue;
      const bool generation = record->kind == JobKind::generation;
      const double spheres = spheres_of(generation ? *record : parent_of(*record));
      const double wall_s = generation ? record->timing.process_wall_s : record->timing.wall_s;
      (record->provenance.cpu_model == cpu_model_ ? here : elsewhere)
          .push_back({spheres, wall_s, static_cast<double>(record->timing.peak_rss_bytes)});
    }
    return {LearnedCost(here.empty() ? elsewhere : here), here.empty() && !elsewhere.empty()};
  }

private:
  Record parent_of(const Record& metric) const { return store_.find(metric.parent).value_or(Record()); }

  /// 0 for a job that this program cannot read, as those of an older revision: its cost may have changed, too.
  double spheres_of(const Record& record) {
    const auto [found, is_new] = spheres_.emplace(record.key, 0);
    if (is_new) {
      try {
        found->second = expected_spheres(read_job(record.canonical).scene);
      } catch (const InputError&) {
        found->second = 0;
      }
    }
    return found->second;
  }

  const Store& store_;
  std::string cpu_model_;
  std::map<std::string, double> spheres_;
};

/// The open jobs of one method or metric.
struct Open {
  std::vector<double> spheres;
  std::vector<double> shares;
  std::int64_t memory_mb = 0;
};

std::string basis(const Learned& learned) {
  const LearnedCost& cost = learned.cost;
  const std::string where = learned.elsewhere ? ", all of other CPU models" : "";
  if (cost.exponent_is_assumed())
    return fmt::format("{} records of {:.0f} spheres{}, taken to grow as N", cost.points(), cost.most(), where);
  return fmt::format("{} records of {:.0f} to {:.0f} spheres{}: as N^{:.2f}", cost.points(), cost.fewest(), cost.most(),
                     where, cost.exponent());
}

std::string memory_in_words(const LearnedCost& cost, const Open& open) {
  const double largest = cost.bytes(*std::max_element(open.spheres.begin(), open.spheres.end())) / kBytesPerMb;
  if (!(largest > 0))
    return "";
  const bool over = open.memory_mb > 0 && largest > static_cast<double>(open.memory_mb);
  return fmt::format(", the largest {:.3g} MB{}", largest, over ? " and so over its budget" : "");
}

} // namespace

std::string costs_in_words(const Agenda& agenda, const Store& store, int cores) {
  std::map<Name, Open> open;
  for (const Item& item : agenda.items) {
    if (item.standing != Standing::open)
      continue;
    const Task& task = agenda.task(item);
    const bool generation = item.kind == JobKind::generation;
    Open& of = open[name_of(agenda, item)];
    of.spheres.push_back(expected_spheres(task.planned.job.scene));
    of.shares.push_back(generation && task.run.timing == TimingMode::exclusive ? 1 : 1.0 / cores);
    if (generation)
      of.memory_mb = std::max(of.memory_mb, task.run.memory_mb);
  }

  std::string text;
  CostSum all;
  std::size_t unknown = 0;
  Teacher teacher(store);
  for (const auto& [name, jobs] : open) {
    const Learned learned = teacher.learn(name);
    if (learned.cost.points() == 0) {
      unknown += jobs.spheres.size();
      text += fmt::format("  {}: {} to run; nothing is known of such jobs here\n", name.second, jobs.spheres.size());
      continue;
    }
    CostSum sum;
    for (std::size_t i = 0; i < jobs.spheres.size(); ++i)
      sum.add(learned.cost, jobs.spheres[i], jobs.shares[i]);
    text += fmt::format("  {}: {} to run; {}{}; from {}\n", name.second, jobs.spheres.size(), sum.text(),
                        memory_in_words(learned.cost, jobs), basis(learned));
    all += sum;
  }
  if (all.seconds() > 0)
    text += fmt::format("all on {} cores: {}{}\n", cores, all.text(),
                        unknown > 0 ? fmt::format(", without the {} of which nothing is known", unknown) : "");
  return text;
}

} // namespace tamp::cli
