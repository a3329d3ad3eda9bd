// Packings, records and campaigns with every field filled, for the tests of the store.
#pragma once

#include "engine/base/random.h"
#include "engine/base/sha256.h"
#include "engine/model/job.h"
#include "engine/model/packing.h"
#include "engine/model/plan.h"
#include "engine/model/record.h"
#include "store/file_digest.h"
#include "store/packing_file.h"
#include "store/record_json.h"
#include "store/record_rows.h"
#include "store/schema.h"
#include "store/store.h"

#include <SQLiteCpp/Transaction.h>

#include <filesystem>
#include <string>

namespace tamp {

/// Spheres anywhere in the box: the store does not care whether they overlap.
inline Packing example_packing(int dimension, std::size_t count, const std::string& seed = "packing") {
  Packing packing;
  packing.dimension = dimension;
  packing.unit = LengthUnit::mm;
  packing.size = {0.1, 1.0 / 3.0, dimension == 3 ? 7e-5 : 0.0};
  packing.boundary = {Boundary::periodic, Boundary::wall, Boundary::wall};
  packing.boundary[static_cast<std::size_t>(dimension - 1)] = Boundary::open;
  RandomStream random(seed, 0);
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < dimension; ++axis)
      packing.positions.push_back(random.uniform());
    packing.radii.push_back(random.uniform());
  }
  return packing;
}

inline Job example_job(std::int64_t replicate) {
  Job job;
  job.scene.dimension = 2;
  job.scene.size = {600, 600};
  job.scene.psd.mu_ln = 0.5;
  job.scene.psd.sigma_ln = 0.25;
  job.replicate = replicate;
  return job;
}

inline Provenance example_provenance() {
  Provenance p;
  p.commit = "0123456789abcdef";
  p.dirty = true;
  p.compiler = "GNU 12.2.0";
  p.flags = "-O3 -DNDEBUG";
  p.libraries = {{"hdf5", "1.10.8"}, {"sqlite", "3.40.1"}};
  p.host = "host";
  p.boot_id = "a-b-c";
  p.pid = 4711;
  p.cpu_model = "a \"model\", with commas";
  p.kernel = "Linux";
  p.hardware_threads = 8;
  p.threads = 2;
  p.start_utc = "2024-05-17T08:09:10.123456Z";
  p.end_utc = "2024-05-17T08:09:11.654321Z";
  return p;
}

/// An ok generation record without a packing.
inline Record example_record(std::int64_t replicate) {
  const Job job = example_job(replicate);
  Record r;
  r.key = job_key(job);
  r.name = "drop-and-roll";
  r.revision = 1;
  r.canonical = canonical(job);
  r.outcome = Outcome::ok;
  r.effects = {{"gravity"}, {{"friction", "mu = 0"}, {"adhesion", "W = 0"}}};
  r.measures = {{"N", 20654, "1"}, {"gap", 0.1 + 0.2, "um"}, {"tiny", 4.9e-324, "1"}};
  r.timing = {
      TimingMode::exclusive, 1.0 / 3.0, 0.3, 0.4, 0.39, 123456789, {1.25, 17, 0.02, "performance", "off its core"}};
  r.timing.samples = {{0.35, 0.3, 0.01, 16, ""}, {0.5, 0.3, 0.01, 1, "off its core"}};
  r.limits = {3600, 1800.5, 4096};
  r.provenance = example_provenance();
  return r;
}

/// An ok record of a metric on the packing of a generation job.
inline Record example_metric_record(const Metric& metric, const std::string& parent, std::vector<Measure> measures) {
  Record r;
  r.key = metric_key(metric, parent);
  r.kind = JobKind::metric;
  r.name = std::string(name_of(metric.name));
  r.revision = 1;
  r.canonical = canonical(metric, parent);
  r.parent = parent;
  r.outcome = Outcome::ok;
  r.measures = std::move(measures);
  r.provenance = example_provenance();
  return r;
}

inline Plan example_plan(const std::string& name, std::int64_t replicates) {
  Plan plan;
  plan.campaign = name;
  plan.title = "An example";
  plan.file = "campaigns/" + name + ".json";
  plan.report.tables = {"lognormal_2d"};
  plan.metrics.resize(1);
  plan.metrics[0].name = MetricName::hellinger;
  for (std::int64_t i = 0; i < replicates; ++i) {
    const Job job = example_job(i);
    plan.jobs.push_back({job, job_key(job), "D&R", {{"scene/psd/mu_ln", "0.5"}}});
  }
  return plan;
}

/// Leaves the result of a child process in `folder`: <key>.h5, then <key>.json. The record, with its packing's digest.
inline Record leave_result(const std::filesystem::path& folder, Record record, const Packing& packing) {
  const auto file = folder / (record.key + ".h5");
  write_packing(file, packing, {record.key, record.canonical, record.name, "0.1.0"});
  record.packing_sha256 = file_sha256(file);
  write_record(folder / (record.key + ".json"), record);
  return record;
}

/// Adds `count` jobs with one ok attempt each in one transaction, where put() would sync the disk for each.
inline void fill_store(const std::filesystem::path& folder, std::int64_t count) {
  SQLite::Database database = open_database(folder / "tamp.sqlite", true);
  Statements statements(database);
  SQLite::Transaction transaction(database);
  Record record = example_record(0);
  for (std::int64_t i = 0; i < count; ++i) {
    record.key = sha256_hex(std::to_string(i));
    insert_record(statements, record);
  }
  transaction.commit();
}

/// The whole record as text, for comparisons that miss no field.
inline std::string text_of(const Record& record) {
  return record_to_json(record);
}

} // namespace tamp
