// tamp job: runs one generation job in this process and leaves its packing and record in a folder.
#include "campaigns/cli/command.h"
#include "campaigns/cli/provenance.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/generate/generator.h"
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

namespace tamp::cli {

namespace {

struct Options {
  std::string file;
  std::string out;
  std::string parent;
  int threads = 1;
};

/// Runs the generator and times it. What it throws is an outcome too, but for want of memory: then there may be too
/// little left to write a record.
Generated timed_generate(const Request& request, Record& record) {
  Generated generated;
  record.provenance.start_utc = utc_now();
  const double wall = steady_seconds();
  const double cpu = process_cpu_seconds(); // of all threads: there is nothing else in this process
  try {
    generated = generate(request);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    generated.outcome = Outcome::failed;
    generated.reason = e.what();
  }
  record.timing.cpu_s = process_cpu_seconds() - cpu;
  record.timing.wall_s = steady_seconds() - wall;
  record.provenance.end_utc = utc_now();
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
                        .checkpoint = std::filesystem::path(options.out) / (record.key + ".checkpoint")};
  Generated generated = timed_generate(request, record);
  record.outcome = generated.outcome;
  record.reason = std::move(generated.reason);
  record.effects = std::move(generated.effects);
  record.measures = std::move(generated.measures);
  const bool counted = std::any_of(record.measures.begin(), record.measures.end(),
                                   [](const Measure& measure) { return measure.name == "N"; });
  if (!counted)
    record.measures.insert(record.measures.begin(),
                           {.name = "N", .value = static_cast<double>(generated.packing.count())});

  // The record comes last: where it is, all is.
  if (leaves_packing(record.outcome))
    keep_packing(generated.packing, record, options.out);
  write_record(std::filesystem::path(options.out) / (record.key + ".json"), record);
  return record.outcome == Outcome::ok ? kOk : kNotAllOk;
}

constexpr const char* kExamples =
    R"(`tamp run` starts this command for each generation job; so does whoever wants to run one job under a debugger
or on another machine. It prints nothing. DIR/KEY.h5 (the packing) and then DIR/KEY.json (the record) appear whole
or not at all; DIR/KEY.checkpoint holds the state of a long job. Exit codes: 0 ok; 1 another outcome, see the record; 2 the job file is at fault; 12 out of memory.)";

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
  app.add_option("--threads", options->threads, "Threads to use; the result does not depend on it")
      ->type_name("N")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
}

} // namespace tamp::cli
