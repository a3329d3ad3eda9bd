// Starts `tamp job` for generations, measures stored packings here, puts every record into the store.
#include "campaigns/cli/local_run.h"

#include "campaigns/cli/provenance.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/measure/measure.h"
#include "engine/schedule/process_executor.h"
#include "store/record_json.h"

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kJobFile = ".job";
constexpr const char* kLogFile = ".log";
constexpr const char* kCheckpoint = ".checkpoint"; // written by the child; outlives all but a result
constexpr const char* kSetAside = ".damaged";

/// The file of a job among the incoming ones.
fs::path incoming_file(const Store& store, const std::string& key, const char* extension) {
  return store.incoming() / (key + extension);
}

/// A generation job as a child: this program, started anew. The child finds the very file this process runs, even if it
/// has been replaced or removed since.
ChildJob prepare_child(const Store& store, const Task& task) {
  const std::string& key = task.planned.key;
  const fs::path job = incoming_file(store, key, kJobFile);
  const fs::path result = incoming_file(store, key, ".json");
  write_atomically(job, job_json(task.planned.job));
  std::vector<std::string> argv = {"/proc/self/exe", "job", job.string(), "--out", store.incoming().string()};
  if (const std::string& parent = task.planned.job.parent; !parent.empty())
    argv.insert(argv.end(), {"--parent", store.packing_path(parent).string()});
  return {.argv = std::move(argv),
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

/// A record of the scheduler goes into the store; if a child left it, together with its packing.
void keep(Store& store, const Record& record) {
  if (record.kind == JobKind::metric) {
    store.put(record);
    return;
  }
  const fs::path json = incoming_file(store, record.key, ".json");
  const fs::path packing = incoming_file(store, record.key, ".h5");
  if (fs::exists(json)) {
    store.import_result(json, packing, [&](Record& stored) { stored.timing = record.timing; });
  } else {
    fs::remove(packing); // without a record it is half a result
    store.put(record);
  }
}

} // namespace

Summary run_here(Store& store, const Agenda& agenda, const Resources& resources, Observer& observer,
                 const std::stop_token& stop) {
  const Provenance origin = this_program();
  Provenance measured_here = origin;
  measured_here.threads = resources.cores;

  ProcessExecutor executor([&](const Task& task) { return prepare_child(store, task); }, origin);
  const Handlers handlers{
      .executor = executor,
      .measure = [&](const Task& task,
                     const Metric& metric) { return measure_stored(store, measured_here, task, metric); },
      .sink =
          [&](const Record& record) {
            keep(store, record);
            for (const char* extension : {kJobFile, kLogFile})
              fs::remove(incoming_file(store, record.key, extension));
            if (leaves_packing(record.outcome))
              fs::remove(incoming_file(store, record.key, kCheckpoint));
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
