// tamp reproduce: runs one record again and says whether its bytes and its measures come out as recorded.
#include "campaigns/cli/child_line.h"
#include "campaigns/cli/command.h"
#include "campaigns/cli/names.h"
#include "campaigns/cli/open_store.h"
#include "campaigns/cli/provenance.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/measure/measure.h"
#include "engine/schedule/process_executor.h"
#include "store/packing_file.h"
#include "store/record_json.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string key;
  std::string store = kDefaultStore;
};

/// A folder that lives as long as the object.
class PassingFolder {
public:
  PassingFolder() {
    std::string name = (fs::temp_directory_path() / "tamp-reproduce-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw Error("no folder can be made in " + fs::temp_directory_path().string());
    path_ = name;
  }
  ~PassingFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

/// Counts and prints what agrees and what does not.
class Verdicts {
public:
  void say(bool agrees, const std::string& what, const std::string& recorded, const std::string& now) {
    ++(agrees ? agreed_ : differing_);
    if (!agrees)
      fmt::print("  {}: {} recorded, {} now\n", what, recorded, now);
  }

  /// Measures of a time are left out: they are of the machine, not of the job.
  void compare(const std::string& of, const std::vector<Measure>& recorded, const std::vector<Measure>& now) {
    for (const Measure& old : recorded) {
      if (old.unit == "s")
        continue;
      const auto found = std::find_if(now.begin(), now.end(), [&](const Measure& m) { return m.name == old.name; });
      const bool agrees = found != now.end() && found->value == old.value && found->unit == old.unit;
      say(agrees, fmt::format("{}{}", of, old.name), fmt::format("{} {}", old.value, old.unit),
          found == now.end() ? "nothing" : fmt::format("{} {}", found->value, found->unit));
    }
  }

  [[nodiscard]] int conclude(const std::string& bytes) const {
    if (differing_ > 0)
      fmt::print("not reproduced: {} of {} comparisons differ{}\n", differing_, agreed_ + differing_, bytes);
    else
      fmt::print("reproduced: all {} comparisons agree{}\n", agreed_, bytes);
    return differing_ == 0 ? kOk : kNotAllOk;
  }

private:
  std::size_t agreed_ = 0;
  std::size_t differing_ = 0;
};

/// The metrics recorded of a packing, measured on another one that should equal it.
void compare_metrics(const std::vector<Record>& recorded, const Packing& packing, const Scene& scene,
                     Verdicts& verdicts) {
  for (const Record& record : recorded) {
    if (record.outcome != Outcome::ok)
      continue;
    try {
      verdicts.compare(record.name + ": ", record.measures,
                       measure(read_metric_job(record.canonical).metric, packing, scene));
    } catch (const std::exception& e) {
      verdicts.say(false, record.name, "measures", e.what());
    }
  }
}

/// The generation job of a record, for another run under the limits it had, where they are known.
Task task_of(const Record& record) {
  Task task;
  task.planned = {.job = read_job(record.canonical), .key = record.key, .label = record.name, .point = {}};
  task.run.wall_s = record.limits.wall_s;
  task.run.cpu_s = record.limits.cpu_s;
  if (record.limits.memory_mb > 0)
    task.run.memory_mb = record.limits.memory_mb;
  return task;
}

/// Runs the job as `tamp run` would, in a folder of its own.
Record run_again(const Store& store, const Task& task, const fs::path& folder) {
  const fs::path result = folder / (task.planned.key + ".json");
  const auto prepare = [&](const Task& due) {
    const fs::path job = folder / "job";
    write_atomically(job, job_json(due.planned.job));
    const std::string& parent = due.planned.job.parent;
    return ChildJob{.argv = child_line(job, folder, parent.empty() ? fs::path() : store.packing_path(parent), due.run),
                    .log = folder / "log",
                    .collect = [&result]() -> std::optional<Record> {
                      return fs::exists(result) ? std::optional(read_record(result)) : std::nullopt;
                    }};
  };
  const std::optional<Record> record =
      ProcessExecutor(prepare, this_program()).run(task, std::nullopt, std::stop_token());
  if (!record)
    throw Error("the job was stopped");
  return *record;
}

bool same_spheres(const Packing& a, const Packing& b) {
  return a.dimension == b.dimension && a.unit == b.unit && a.size == b.size && a.boundary == b.boundary &&
         a.positions == b.positions && a.radii == b.radii;
}

int reproduce_generation(const Store& store, const Record& record) {
  const PassingFolder folder;
  const Task task = task_of(record);
  const Record now = run_again(store, task, folder.path());
  Verdicts verdicts;
  verdicts.say(now.outcome == record.outcome, "outcome", std::string(name_of(record.outcome)),
               fmt::format("{} ({})", name_of(now.outcome), now.reason));
  verdicts.compare("", record.measures, now.measures);
  std::string bytes;
  if (leaves_packing(record.outcome) && leaves_packing(now.outcome)) {
    const bool same_file = now.packing_sha256 == record.packing_sha256;
    const Packing packing = read_packing(folder.path() / (record.key + ".h5"));
    // The file also names the program that wrote it, so that another version may write other bytes for equal spheres.
    const bool same = same_file || same_spheres(packing, store.read_packing(record.key));
    verdicts.say(same, "spheres", "those of its file", "others");
    bytes = same_file ? "; the packing's file has the same bytes"
            : same    ? "; the packing's file has other bytes, but every sphere agrees to the last bit"
                      : "";
    compare_metrics(store.metric_records(record.key), packing, task.planned.job.scene, verdicts);
  }
  return verdicts.conclude(bytes);
}

int reproduce_metric(const Store& store, const Record& record) {
  const std::optional<Record> parent = store.find(record.parent);
  if (!parent)
    throw Error(fmt::format("the packing {} that it measures is not in this store", record.parent));
  Verdicts verdicts;
  compare_metrics({record}, store.read_packing(record.parent), read_job(parent->canonical).scene, verdicts);
  return verdicts.conclude("");
}

int reproduce(const Options& options) {
  const Store store = open_for_reading(options.store);
  const Record record = *store.find(whole_key(store, options.key));
  fmt::print("{}: {} by {}, revision {}, {} on {}\n", record.key, name_of(record.kind), record.name, record.revision,
             record.provenance.commit, record.provenance.host);
  if (record.kind == JobKind::generation)
    return reproduce_generation(store, record);
  if (record.outcome != Outcome::ok)
    throw InputError(fmt::format("there is nothing to compare: the metric ended as {}", name_of(record.outcome)));
  return reproduce_metric(store, record);
}

constexpr const char* kExamples =
    R"(A packing is made again, under the limits it had, in a passing folder, and compared with the stored one sphere by sphere
and metric by metric; times are not compared. A metric is measured again on the stored packing. The store stays as it is.
Exit codes: 0 all agrees; 1 something differs, which is told; 2 there is no such record, or this tamp has another revision
of its method.
Example:
  tamp reproduce --store results 3fa91c)";

} // namespace

void declare_reproduce(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("reproduce", "Run one record again and say whether it comes out the same", kExamples,
                           [options] { return reproduce(*options); });
  app.add_option("key", options->key, "Key of a job, or its first digits")->type_name("KEY")->required();
  add_store_option(app, options->store);
}

} // namespace tamp::cli
