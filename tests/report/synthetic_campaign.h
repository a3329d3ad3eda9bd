// A campaign with invented records, for tests of tables and notes without a store.
#pragma once

#include "report/report.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tamp::test {

inline Scene paper_scene(int dimension) {
  Scene scene;
  scene.dimension = dimension;
  scene.size = {dimension == 2 ? 600.0 : 133.0};
  scene.psd.mu_ln = 0.30;
  scene.psd.sigma_ln = 0.68;
  scene.psd.r_min = 0.1;
  scene.psd.r_max = 50;
  return completed(scene);
}

inline Method method_named(MethodName name) {
  Method method;
  method.name = name;
  return method;
}

/// A plan and the records that a store would hold.
struct SyntheticCampaign {
  Plan plan;
  std::map<std::string, Record> records;

  SyntheticCampaign() {
    plan.campaign = "synthetic";
    plan.title = "A synthetic campaign";
    plan.file = "campaigns/synthetic.json";
    plan.report.tables = {"lognormal_2d", "lognormal_3d"};
    for (const MetricName name : {MetricName::hellinger, MetricName::phi, MetricName::phi_paper, MetricName::overlap,
                                  MetricName::stable_alone, MetricName::coordination})
      plan.metrics.push_back({name});
  }

  /// Adds a job to the plan; it has no record yet.
  std::string plan_job(const Scene& scene, std::int64_t replicate, const std::string& label = "D&R",
                       const Method& method = {}, const std::string& parent = "") {
    PlannedJob planned;
    planned.job.parent = parent;
    planned.job.scene = scene;
    planned.job.method = method;
    planned.job.replicate = replicate;
    planned.key = job_key(planned.job);
    planned.label = label;
    plan.jobs.push_back(planned);
    return planned.key;
  }

  Record& add_record(const std::string& key, JobKind kind, std::string name) {
    Record record;
    record.key = key;
    record.kind = kind;
    record.name = std::move(name);
    record.revision = 1;
    record.outcome = Outcome::ok;
    record.provenance.commit = "0123456789abcdef0123456789abcdef01234567";
    record.provenance.compiler = "GNU 12.2.0";
    record.provenance.flags = "-O3 -DNDEBUG";
    record.provenance.libraries = {{"eigen", "3.4.0"}, {"hdf5", "1.10.8"}};
    record.provenance.host = "bench";
    record.provenance.cpu_model = "Example CPU & Co 3000_X";
    record.provenance.kernel = "Linux 6.1";
    record.provenance.hardware_threads = 2;
    record.provenance.start_utc = "2024-05-01T08:00:00.000000Z";
    record.provenance.end_utc = "2024-05-01T08:00:01.000000Z";
    return records[key] = record;
  }

  /// A job that ended ok, with all metrics; phi_paper and time differ between replicates, the rest follows from them.
  std::string add_ok(const Scene& scene, std::int64_t replicate, double phi_paper, double wall_s,
                     const std::string& label = "D&R", const Method& method = {}, const std::string& parent = "") {
    const std::string key = plan_job(scene, replicate, label, method, parent);
    Record& generation = add_record(key, JobKind::generation, std::string(name_of(method.name)));
    generation.measures = {{"N", 20000.0 + static_cast<double>(replicate) * 10, "1"}};
    generation.parent = parent;
    generation.timing = {TimingMode::exclusive, wall_s, wall_s, wall_s, wall_s, 1000000};
    const std::string weighted = scene.dimension == 2 ? "H_S" : "H_V";
    add_metric(key, 0,
               {{"H_N", 0.02}, {weighted, 0.15}, {"H_N_floor", 0.0201}, {weighted + "_floor", 0.16}, {"bins", 80}});
    add_metric(key, 1, {{"phi", phi_paper + 0.01}});
    add_metric(key, 2, {{"phi_paper", phi_paper}, {"N_PB", 16000}});
    add_metric(key, 3, {{"overlap_max", 1.5e-14 * static_cast<double>(replicate + 1)}, {"overlap_pairs", 0}});
    add_metric(key, 4, {{"stable_alone", 1}, {"unstable_count", 0}});
    add_metric(key, 5, {{"z", 3.9}});
    return key;
  }

  void add_metric(const std::string& packing, std::size_t index,
                  const std::vector<std::pair<std::string, double>>& values) {
    const Metric& metric = plan.metrics[index];
    Record& record = add_record(metric_key(metric, packing), JobKind::metric, std::string(name_of(metric.name)));
    record.parent = packing;
    for (const auto& [name, value] : values)
      record.measures.push_back({name, value, "1"});
  }

  [[nodiscard]] std::string key_of_metric(const std::string& packing, std::size_t index) const {
    return metric_key(plan.metrics[index], packing);
  }

  [[nodiscard]] std::vector<Run> runs() const {
    return collect_runs(plan, [this](const std::string& key) -> std::optional<Record> {
      const auto found = records.find(key);
      return found == records.end() ? std::nullopt : std::optional(found->second);
    });
  }

  /// The files of the report by name.
  [[nodiscard]] std::map<std::string, std::string> report() const {
    const std::vector<Run> joined = runs();
    std::map<std::string, std::string> files;
    for (const ReportFile& file : make_report({plan, joined, "tamp run " + plan.file}))
      files[file.name] = file.bytes;
    return files;
  }
};

} // namespace tamp::test
