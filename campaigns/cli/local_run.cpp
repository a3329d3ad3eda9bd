// Starts `tamp job` for generations, measures stored packings here, puts every record into the store.
#include "campaigns/cli/local_run.h"

#include "campaigns/cli/child_line.h"
#include "campaigns/cli/provenance.h"
#include "campaigns/cli/shared_run.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/measure/measure.h"
#include "engine/schedule/process_executor.h"
#include "store/record_json.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kJobFile = ".job";
constexpr const char* kLogFile = ".log";
constexpr const char* kCheckpoint = ".checkpoint"; // written by the child; outlives all but a result
constexpr const char* kFiles = ".files";           // folder with the scripts and logs of a program that a child started
constexpr const char* kSetAside = ".damaged";

/// The file of a job among the incoming ones.
fs::path incoming_file(const Store& store, const std::string& key, const char* extension) {
  return store.incoming() / (key + extension);
}

/// A generation job as a child: this program, started anew.
ChildJob prepare_child(const Store& store, const Task& task) {
  const std::string& key = task.planned.key;
  const fs::path job = incoming_file(store, key, kJobFile);
  const fs::path result = incoming_file(store, key, ".json");
  write_atomically(job, job_json(task.planned.job));
  const std::string& parent = task.planned.job.parent;
  return {.argv = child_line(job, store.incoming(), parent.empty() ? fs::path() : store.packing_path(parent), task.run),
          .log = incoming_file(store, key, kLogFile),
          .collect = [result]() -> std::optional<Record> {
            return fs::exists(result) ? std::optional(read_record(result)) : std::nullopt;
          }};
}

/// The packing of a job. One that cannot be read is set aside under another name, so that the next run makes it again.
Packing read_or_set_aside(const Store& store, const std::string& key) {
  try {
    return store.read_packing(key);
  } catch (const Error& e) {
    const fs::path file = store.packing_path(key);
    std::error_code failed;
    fs::rename(file, file.string() + kSetAside, failed);
    if (failed)
      throw;
    throw Error(fmt::format("{}; it has been set aside as {}{}, and the next run makes it again", e.what(),
                            file.filename().string(), kSetAside));
  }
}

/// Measures a stored packing and times that. CPU time is that of the measuring thread alone, as other jobs run beside.
Record measure_stored(const Store& store, const Provenance& origin, const Task& task, const Metric& metric) {
  Record record;
  record.key = metric_key(metric, task.planned.key);
  record.kind = JobKind::metric;
  record.name = name_of(metric.name);
  record.revision = info(metric.name).revision;
  record.canonical = canonical(metric, task.planned.key);
  record.parent = task.planned.key;
  record.provenance = origin;
  record.provenance.start_utc = utc_now();
  try {
    const Packing packing = read_or_set_aside(store, task.planned.key);
    const double wall = steady_seconds();
    const double cpu = thread_cpu_seconds();
    record.measures = measure(metric, packing, task.planned.job.scene);
    record.timing.cpu_s = thread_cpu_seconds() - cpu;
    record.timing.wall_s = steady_seconds() - wall;
    record.outcome = Outcome::ok;
  } catch (const NotApplicable& e) {
    record.outcome = Outcome::not_applicable;
    record.reason = e.what();
  } catch (const std::exception& e) {
    record.outcome = Outcome::failed;
    record.reason = e.what();
  }
  record.provenance.end_utc = utc_now();
  return record;
}

/// Scripts and logs go to the packing that they made, as KEY.files beside it; those of no packing stay where they are.
void keep_files(const Store& store, const Record& record) {
  const fs::path made = incoming_file(store, record.key, kFiles);
  if (!leaves_packing(record.outcome) || !fs::exists(made))
    return;
  fs::path kept = store.packing_path(record.key);
  kept.replace_extension(kFiles);
  fs::remove_all(kept);
  fs::rename(made, kept);
}

/// A record of the scheduler goes into the store; if a child left it, together with its packing.
void keep(Store& store, const Record& record) {
  if (record.kind == JobKind::metric) {
    store.put(record);
    return;
  }
  const fs::path json = incoming_file(store, record.key, ".json");
  const fs::path packing = incoming_file(store, record.key, ".h5");
  if (fs::exists(json)) {
    store.import_result(json, packing, [&](Record& stored) {
      stored.timing = record.timing;
      stored.limits = record.limits;
    });
  } else {
    fs::remove(packing); // without a record it is half a result
    store.put(record);
  }
}

/// Sees to it that of all the runs in a store one alone is at a job.
class Claimant {
public:
  explicit Claimant(const Store& store)
      : store_(store), claims_(claims_file(store.folder())), before_(store.outcomes()) {}

  /// Claims a job. False if another run is at it, or has ended it since this one began.
  bool take(const std::string& key) {
    if (!claims_.take(key))
      return false;
    const std::optional<Outcome> now = store_.outcome(key);
    const auto before = before_.find(key);
    const bool ended = now && is_final(*now) && (before == before_.end() || before->second != *now);
    if (ended)
      claims_.give_back(key);
    return !ended;
  }
  void give_back(const std::string& key) { claims_.give_back(key); }

private:
  const Store& store_;
  Claims claims_;
  std::map<std::string, Outcome> before_;
};

/// Leaves alone the jobs that others are at.
class ClaimingExecutor final : public Executor {
public:
  ClaimingExecutor(Executor& inner, Claimant& claimant) : inner_(inner), claimant_(claimant) {}
  std::optional<Record> run(const Task& task, std::optional<int> core, std::stop_token stop) override {
    if (!claimant_.take(task.planned.key))
      return std::nullopt;
    std::optional<Record> record = inner_.run(task, core, std::move(stop));
    if (!record)
      claimant_.give_back(task.planned.key);
    return record;
  }

private:
  Executor& inner_;
  Claimant& claimant_;
};

} // namespace

Summary run_here(Store& store, const Agenda& agenda, const Resources& resources, Observer& observer,
                 const std::stop_token& stop) {
  const Provenance origin = this_program();
  Provenance measured_here = origin;
  measured_here.threads = resources.cores;

  Claimant claimant(store);
  ProcessExecutor children([&](const Task& task) { return prepare_child(store, task); }, origin);
  ClaimingExecutor executor(children, claimant);
  const Handlers handlers{.executor = executor,
                          .measure = [&](const Task& task, const Metric& metric) -> std::optional<Record> {
                            if (!claimant.take(metric_key(metric, task.planned.key)))
                              return std::nullopt;
                            return measure_stored(store, measured_here, task, metric);
                          },
                          .sink =
                              [&](const Record& record) {
                                keep(store, record);
                                if (record.kind == JobKind::generation) {
                                  keep_files(store, record);
                                  store.keep_log(record.key, incoming_file(store, record.key, kLogFile));
                                }
                                fs::remove(incoming_file(store, record.key, kJobFile));
                                if (leaves_packing(record.outcome))
                                  fs::remove(incoming_file(store, record.key, kCheckpoint));
                                claimant.give_back(record.key);
                              },
                          .observer = observer};
  try {
    return run_agenda(agenda, resources, handlers, stop);
  } catch (const fs::filesystem_error& e) {
    throw Error(e.what());
  }
}

void sweep_working_files(const Store& store) {
  for (const auto& entry : fs::directory_iterator(store.incoming())) {
    const fs::path extension = entry.path().extension();
    if (extension == kJobFile || extension == kLogFile)
      fs::remove(entry.path());
  }
}

} // namespace tamp::cli
