// tamp element: what one element of a job array runs, on a node of the cluster: its jobs, one after the other.
#include "campaigns/cli/child_line.h"
#include "campaigns/cli/command.h"
#include "campaigns/cli/interrupt.h"
#include "campaigns/cli/provenance.h"
#include "campaigns/cli/submission.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/schedule/process_executor.h"
#include "store/record_json.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string folder;
  std::size_t array = 0;
  std::size_t element = 0;
};

void say(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

/// The parent's packing under a name of the attempt's own: whoever collects may move it at any moment. It lies in the
/// store, or where another element of this submission left it. False if it is nowhere.
bool fetch_parent(const Submission& submission, const std::string& parent, const fs::path& to) {
  const std::string name = parent + ".h5";
  const auto take = [&](const fs::path& from) {
    std::error_code error;
    fs::create_hard_link(from, to, error);
    if (error && fs::exists(from))
      fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
    return !error;
  };
  const fs::path store = submission.folder.parent_path().parent_path();
  const fs::path home = store / "packings" / parent.substr(0, 2) / name;
  if (take(home))
    return true;
  for (const fs::path& attempt : attempt_folders(submission, parent)) {
    if (fs::exists(attempt / "result.json") && take(attempt / name))
      return true;
  }
  return take(home); // collected between the two looks
}

/// The child of one job; its result lies in the folder of the attempt.
ChildJob child_of(const Submission& submission, const Task& task, const fs::path& attempt) {
  const std::string& key = task.planned.key;
  const fs::path result = attempt / (key + ".json");
  const fs::path parent = task.planned.job.parent.empty() ? fs::path() : attempt / "parent.h5";
  return {.argv = child_line(submission.job_file(key), attempt, parent, task.run),
          .log = attempt / "log",
          .collect = [result]() -> std::optional<Record> {
            return fs::exists(result) ? std::optional(read_record(result)) : std::nullopt;
          }};
}

/// Whether another element has run it already: a controller restarted may start an element twice.
bool has_result(const Submission& submission, const std::string& key) {
  for (const fs::path& attempt : attempt_folders(submission, key)) {
    if (fs::exists(attempt / "result.json"))
      return true;
  }
  return false;
}

/// Runs one job; false if it was stopped from outside.
bool run_one(const Submission& submission, const RunSettings& run, const std::string& key, std::stop_token stop) {
  if (has_result(submission, key)) {
    say(key + ": has a result already");
    return true;
  }
  Task task;
  task.planned.key = key;
  task.planned.job = read_job(read_file(submission.job_file(key)));
  task.run = run;
  const fs::path attempt = new_attempt(submission, key);
  if (const std::string& parent = task.planned.job.parent; !parent.empty()) {
    if (!fetch_parent(submission, parent, attempt / "parent.h5")) {
      say(fmt::format("{}: not run, as its parent {} has left no packing", key, parent));
      fs::remove(attempt);
      return true;
    }
  }
  ProcessExecutor executor([&](const Task& one) { return child_of(submission, one, attempt); }, this_program());
  const bool exclusive = run.timing == TimingMode::exclusive;
  const std::optional<int> core = exclusive ? std::optional(usable_cores().back()) : std::nullopt;
  const std::optional<Record> record = executor.run(task, core, std::move(stop));
  if (!record) {
    say(key + ": stopped");
    return false;
  }
  write_record(attempt / "result.json", *record); // the last word: where it is, all is
  say(fmt::format("{}: {}", key, name_of(record->outcome)));
  return true;
}

int run_element(const Options& options) {
  const Interrupt interrupt; // Slurm says SIGTERM before SIGKILL
  const Submission submission = read_submission(options.folder);
  const SubmittedArray& array = submission.arrays.at(options.array);
  bool all = true;
  for (const std::string& key : array.elements.at(options.element)) {
    try {
      if (!run_one(submission, array.run, key, interrupt.token()))
        return kCancelled;
    } catch (const std::exception& e) { // this job's files are at fault; the others go on
      say(fmt::format("{}: {}", key, e.what()));
      all = false;
    }
  }
  return all ? kOk : kNotAllOk;
}

constexpr const char* kExamples =
    R"(`tamp submit` makes scripts that start this command on the nodes of a cluster. It runs `tamp job` for each job of the
element under the limits of the campaign, as `tamp run` does, and leaves results for `tamp collect`.)";

} // namespace

void declare_element(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("element", "Run one element of a job array, on a node of the cluster", kExamples,
                           [options] { return run_element(*options); });
  app.add_option("folder", options->folder, "Folder of the submission")->type_name("DIR")->required();
  app.add_option("array", options->array, "Number of the array")->type_name("ARRAY")->required();
  app.add_option("element", options->element, "Number of the element")->type_name("ELEMENT")->required();
}

} // namespace tamp::cli
