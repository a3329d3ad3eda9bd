// tamp job: runs one generation job in this process and leaves its packing and record in a folder.
#include "campaigns/cli/command.h"
#include "campaigns/cli/provenance.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/generate/generator.h"
#include "engine/schedule/disturbance.h"
#include "engine/schedule/process_executor.h"
#include "store/file_digest.h"
#include "store/packing_file.h"
#include "store/record_json.h"
#include "tamp_build_info.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tamp::cli {

namespace {

/// What a job that was out of time had reached, beside the files of its program: no packing of the store.
constexpr const char* kReached = "reached.h5";

constexpr double kLeastWall_s = 0.001; ///< what a generator is told when its time is up

struct Options {
  std::string file;
  std::string out;
  std::string parent;
  int threads = 1;
  double wall_s = 0;
  double warm_up_s = 0;
  int samples = 1;
};

/// Keeps the core busy for this long, so that its frequency has risen before the time is taken.
void warm_up(double seconds) {
  const double start = steady_seconds();
  while (steady_seconds() - start < seconds)
    continue;
}

/// Runs the generator and times it. What it throws is an outcome too, but for want of memory: then there may be too
/// little left to write a record.
Generated generate_once(const Request& request, TimeSample& sample) {
  Generated generated;
  const std::vector<int> cores = usable_cores();
  const double stolen = stolen_seconds(cores);
  const std::int64_t switches = involuntary_switches();
  const double wall = steady_seconds();
  const double cpu = process_cpu_seconds(); // of all threads: there is nothing else in this process but child programs
  try {
    generated = generate(request);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    generated.outcome = Outcome::failed;
    generated.reason = e.what();
  }
  sample.cpu_s = process_cpu_seconds() - cpu + generated.programs_cpu_s;
  sample.wall_s = steady_seconds() - wall;
  sample.steal_s = stolen_seconds(cores) - stolen;
  sample.switches = involuntary_switches() - switches;
  return generated;
}

/// Forgets how far the last run of a generator came, so that the next one has all the work to do.
void clear_traces(const Request& request) {
  std::filesystem::remove(request.checkpoint);
  std::filesystem::remove_all(request.folder);
}

/// Runs the generator as often as times are wanted; the same job makes the same packing each time.
Generated timed_generate(Request request, int samples, Record& record) {
  Conditions& conditions = record.timing.conditions;
  conditions.load = load_average()[0];
  conditions.governor = frequency_governor(usable_cores().front());
  record.provenance.start_utc = utc_now();
  Generated generated;
  std::vector<TimeSample>& taken = record.timing.samples;
  do {
    if (!taken.empty()) {
      clear_traces(request);
      if (request.wall_s > 0) // 0 would be no bound
        request.wall_s = std::max(request.wall_s - taken.back().wall_s, kLeastWall_s);
    }
    generated = {}; // two packings at a time would count as the job's memory
    generated = generate_once(request, taken.emplace_back());
    conditions.steal_s += taken.back().steal_s;
    conditions.switches += taken.back().switches;
  } while (generated.outcome == Outcome::ok && std::cmp_less(taken.size(), samples));
  record.provenance.end_utc = utc_now();
  settle_time(record.timing);
  if (taken.size() == 1)
    taken.clear();
  return generated;
}

/// The packing that a job starts from; nothing if it starts from its scene.
std::optional<Packing> read_parent(const Job& job, const std::string& file) {
  if (job.parent.empty() != file.empty())
    throw InputError(file.empty() ? "the job starts from packing " + job.parent + ": state its file by --parent"
                                  : "the job starts from no packing, but --parent states one");
  if (file.empty())
    return std::nullopt;
  if (const std::string key = read_packing_label(file).key; key != job.parent)
    throw InputError(fmt::format("{}: holds packing {}, but the job starts from {}", file, key, job.parent));
  return read_packing(file);
}

void keep_packing(const Packing& packing, Record& record, const std::filesystem::path& out) {
  const std::filesystem::path file = out / (record.key + ".h5");
  write_packing(file, packing,
                {.key = record.key,
                 .canonical = record.canonical,
                 .method = record.name,
                 .creator_version = std::string(build_info::version)});
  record.packing_file = file.filename().string();
  record.packing_sha256 = file_sha256(file);
}

int run_job(const Options& options) {
  const Job job = read_job(read_file(options.file));
  Record record = blank_record({.job = job, .key = job_key(job), .label = {}, .point = {}}, this_program());
  record.provenance.threads = options.threads;

  const std::optional<Packing> parent = read_parent(job, options.parent);
  const Request request{.job = job,
                        .key = record.key,
                        .parent = parent ? &*parent : nullptr,
                        .checkpoint = std::filesystem::path(options.out) / (record.key + ".checkpoint"),
                        .folder = std::filesystem::path(options.out) / (record.key + ".files"),
                        .wall_s = options.wall_s};
  warm_up(options.warm_up_s);
  Generated generated = timed_generate(request, options.samples, record);
  record.outcome = generated.outcome;
  record.reason = std::move(generated.reason);
  record.effects = std::move(generated.effects);
  record.measures = std::move(generated.measures);
  record.provenance.libraries.merge(generated.programs);
  const bool counted = std::any_of(record.measures.begin(), record.measures.end(),
                                   [](const Measure& measure) { return measure.name == "N"; });
  if (!counted)
    record.measures.insert(record.measures.begin(),
                           {.name = "N", .value = static_cast<double>(generated.packing.count())});

  // The record comes last: where it is, all is.
  if (leaves_packing(record.outcome))
    keep_packing(generated.packing, record, options.out);
  else if (record.outcome == Outcome::time_limited && std::filesystem::exists(request.folder))
    write_packing(
        request.folder / kReached, generated.packing,
        {.key = {}, .canonical = {}, .method = record.name, .creator_version = std::string(build_info::version)});
  write_record(std::filesystem::path(options.out) / (record.key + ".json"), record);
  return record.outcome == Outcome::ok ? kOk : kNotAllOk;
}

constexpr const char* kExamples =
    R"(`tamp run` starts this command for each generation job; so does whoever wants to run one job under a debugger
or on another machine. It prints nothing. DIR/KEY.h5 (the packing) and then DIR/KEY.json (the record) appear whole
or not at all; DIR/KEY.checkpoint holds the state of a long job; DIR/KEY.files/reached.h5 what one had reached that was out of time. Exit codes: 0 ok; 1 another outcome, see the record; 2 the job file is at fault; 12 out of memory.)";

} // namespace

void declare_job(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("job", "Run one generation job in this process", kExamples, [options] {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(options->threads));
    try {
      return run_job(*options);
    } catch (const std::bad_alloc&) {
      return kExitOutOfMemory;
    }
  });
  app.add_option("file", options->file, "Job file: the canonical text of a job")->type_name("JOBFILE")->required();
  app.add_option("--out", options->out, "Folder for the result; must exist")->type_name("DIR")->required();
  app.add_option("--parent", options->parent, "Packing file that the job starts from, if it has a parent")
      ->type_name("FILE");
  app.add_option("--wall", options->wall_s,
                 "Seconds after which it is killed; some methods end in time and keep what they reached. 0: none")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--warm-up", options->warm_up_s, "Keep the core busy before the time is taken")
      ->type_name("S")
      ->check(CLI::Range(0., 60.));
  app.add_option("--samples", options->samples, "Run it so often, to time it so often")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  app.add_option("--threads", options->threads, "Threads to use; the result does not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
}

} // namespace tamp::cli
