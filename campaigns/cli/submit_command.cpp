// tamp submit: hands what is missing of campaigns to a cluster.
#include "campaigns/cli/command.h"
#include "campaigns/cli/open_store.h"
#include "campaigns/cli/shared_run.h"
#include "campaigns/cli/submission.h"
#include "campaigns/cluster_profile.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/schedule/slurm.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> files;
  std::string store = kDefaultStore;
  std::string executor = "slurm";
  std::string profile;
  bool retry_limited = false;
};

/// Keys that an earlier submission still looks after.
std::set<std::string> under_way(const Store& store) {
  std::set<std::string> keys;
  for (const Submission& submission : submissions(store)) {
    const std::vector<std::string> settled = read_settled(submission);
    const std::set<std::string> done(settled.begin(), settled.end());
    for (const SubmittedArray& array : submission.arrays) {
      for (const auto& element : array.elements) {
        for (const std::string& key : element) {
          if (!done.contains(key))
            keys.insert(key);
        }
      }
    }
  }
  return keys;
}

/// Generations to hand in, and those that cannot be as yet.
struct Selection {
  std::vector<std::size_t> tasks;
  std::size_t under_way = 0;
  std::size_t waiting = 0; ///< their parents are under way in an earlier submission
};

Selection select(const Agenda& agenda, const std::set<std::string>& busy) {
  Selection selection;
  std::set<std::string> waiting;
  for (const Item& item : agenda.items) {
    if (item.kind != JobKind::generation || item.standing != Standing::open)
      continue;
    const std::string& parent = agenda.task(item).planned.job.parent;
    if (busy.contains(item.key)) {
      ++selection.under_way;
    } else if (busy.contains(parent) || waiting.contains(parent)) {
      ++selection.waiting;
      waiting.insert(item.key);
    } else {
      selection.tasks.push_back(item.task);
    }
  }
  return selection;
}

/// A name that no other submission has, as Slurm is asked by it.
std::string new_id() {
  std::string id = utc_now().substr(0, 23); // to the millisecond
  std::erase_if(id, [](char c) { return c == '-' || c == ':' || c == '.'; });
  return fmt::format("{}-{}", id, ::getpid());
}

std::string element_script(const Submission& submission) {
  // The array comes from its name, so that one script serves all.
  return fmt::format("#!/bin/sh\nexec '{}' element '{}' \"${{SLURM_JOB_NAME##*-}}\" \"$SLURM_ARRAY_TASK_ID\"\n",
                     fs::read_symlink("/proc/self/exe").string(), submission.folder.string());
}

Submission make_submission(const Store& store, const Options& options, const Agenda& agenda,
                           const std::vector<ClusterArray>& arrays, const ClusterProfile& profile) {
  const std::string id = new_id();
  Submission submission;
  submission.folder = cluster_folder(store) / id;
  submission.created_utc = utc_now();
  submission.settle_s = profile.settle_s;
  for (const std::string& file : options.files)
    submission.campaigns.push_back(fs::absolute(file));
  for (const ClusterArray& array : arrays) {
    SubmittedArray& made = submission.arrays.emplace_back();
    made.name = fmt::format("tamp-{}-{}", id, submission.arrays.size() - 1);
    made.run = array.run;
    for (const auto& element : array.elements) {
      made.elements.emplace_back();
      for (const std::size_t t : element)
        made.elements.back().push_back(agenda.tasks[t].planned.key);
    }
  }
  fs::create_directories(submission.logs());
  for (const ClusterArray& array : arrays) {
    for (const auto& element : array.elements) {
      for (const std::size_t t : element)
        write_atomically(submission.job_file(agenda.tasks[t].planned.key), job_json(agenda.tasks[t].planned.job));
    }
  }
  write_atomically(submission.folder / "array.sh", element_script(submission));
  write_submission(submission); // before the first array: whatever happens next, its name is known
  return submission;
}

/// Leaves the first arrays in the submission: the others have not been handed in.
void keep_arrays(Submission& submission, std::size_t count) {
  submission.arrays.resize(count);
  if (count == 0)
    fs::remove_all(submission.folder);
  else
    write_submission(submission);
}

void hand_in(Submission& submission, const std::vector<ClusterArray>& arrays, const ClusterProfile& profile) {
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    std::vector<std::string> after;
    for (const std::size_t earlier : arrays[a].after)
      after.push_back(submission.arrays[earlier].number);
    try {
      submission.arrays[a].number = submit({.name = submission.arrays[a].name,
                                            .array = arrays[a],
                                            .after = std::move(after),
                                            .script = submission.folder / "array.sh",
                                            .logs = submission.logs()},
                                           profile);
    } catch (const SlurmRefused&) {
      keep_arrays(submission, a); // what Slurm does not have must not be waited for
      throw;
    } catch (const Error&) {
      keep_arrays(submission, a + 1); // Slurm may have it all the same; `collect` looks for it by its name
      throw;
    }
    write_submission(submission);
  }
}

int submit_campaigns(const Options& options) {
  const std::vector<Plan> plans = load_campaigns(options.files);
  const ClusterProfile profile = options.profile.empty() ? ClusterProfile{} : load_cluster_profile(options.profile);
  Store store = Store::open(options.store, Store::Mode::create);
  const Seat seat = hold_alone(store.folder());
  store.sweep_incoming();
  for (const Plan& plan : plans)
    store.put_campaign(plan);
  const Agenda agenda =
      make_agenda(plans, known_to(store, options.retry_limited ? Limited::open : Limited::done, plans));
  const Selection selection = select(agenda, under_way(store));

  if (selection.under_way > 0)
    fmt::print("on the cluster already: {} jobs\n", selection.under_way);
  if (selection.waiting > 0)
    fmt::print("to be submitted after `tamp collect`, as they start from packings under way: {} jobs\n",
               selection.waiting);
  if (selection.tasks.empty()) {
    fmt::print("nothing to submit\n");
    return kOk;
  }
  const std::vector<ClusterArray> arrays = arrange(agenda, selection.tasks, profile, largest_array());
  Submission submission = make_submission(store, options, agenda, arrays, profile);
  hand_in(submission, arrays, profile);
  fmt::print("submitted: {} jobs in {} arrays\n", selection.tasks.size(), arrays.size());
  for (const SubmittedArray& array : submission.arrays)
    fmt::print("  {}: {} elements\n", array.number, array.elements.size());
  fmt::print("`tamp collect --store {}` takes in what is done; with --wait, until all is\n", options.store);
  return kOk;
}

constexpr const char* kExamples =
    R"(Hands the packings that are missing to a cluster as job arrays and returns; `tamp collect` takes in the results and
measures them. The store must lie where the nodes see it. Jobs that start from the packing of others wait for those.
The profile is a JSON file; every key may be left out:
  {"partition": "", "account": "", "qos": "", "constraint": "", "max_running": 0, "array_size": 1000,
   "bundle_jobs": 50, "bundle_wall_s": 600, "memory_overhead_mb": 200, "settle_s": 30, "patience_s": 30}
Jobs whose time budgets add up to no more than bundle_wall_s share an element. Time and memory come from the budgets of
the campaign. An element that is gone without a result for settle_s seconds is lost; jobs that are lost or cancelled are
submitted again by the same command.
Examples:
  tamp submit campaigns/lognormal-3d.json --executor slurm --profile cluster.json --store results
  tamp collect --store results --wait)";

} // namespace

void declare_submit(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("submit", "Hand what is missing of campaigns to a cluster", kExamples,
                           [options] { return submit_campaigns(*options); });
  app.add_option("files", options->files, "Campaign files")->type_name("FILE")->required();
  app.add_option("--executor", options->executor, "Kind of cluster")
      ->check(CLI::IsMember({"slurm"}))
      ->capture_default_str();
  app.add_option("--profile", options->profile, "What the cluster wants to know; see below")->type_name("FILE");
  app.add_flag("--retry-limited", options->retry_limited, "Submit jobs again that ran out of time or memory");
  add_store_option(app, options->store);
}

} // namespace tamp::cli
