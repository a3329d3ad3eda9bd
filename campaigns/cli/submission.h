// A submission: what one `tamp submit` handed to a cluster, as a folder of the store that elements read and fill.
#pragma once

#include "engine/model/cluster_profile.h"
#include "engine/model/plan.h"
#include "store/store.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tamp::cli {

/// One job array of a submission.
struct SubmittedArray {
  std::string name;   ///< in Slurm; unique
  std::string number; ///< Slurm's; empty until it is known
  RunSettings run;
  std::vector<std::vector<std::string>> elements; ///< keys
};

/// STORE/cluster/ID/:
///   submission.json        this structure, rewritten as a whole
///   settled.json           keys that need no more looking after
///   array.sh, KEY.job      what an element runs
///   logs/NAME_ELEMENT.log  what elements print
///   attempts/KEY/N/        a run of a job, from 1: parent.h5, KEY.h5, KEY.json, log, and at last result.json
/// Two elements that run the same job (a controller restarted) use two attempts and do not disturb each other.
struct Submission {
  std::filesystem::path folder;
  std::string created_utc;
  std::vector<std::filesystem::path> campaigns; ///< files, absolute
  double settle_s = 0;
  std::vector<SubmittedArray> arrays;

  [[nodiscard]] std::filesystem::path job_file(const std::string& key) const { return folder / (key + ".job"); }
  [[nodiscard]] std::filesystem::path logs() const { return folder / "logs"; }
  [[nodiscard]] std::filesystem::path attempts(const std::string& key) const { return folder / "attempts" / key; }
};

/// Where submissions of a store lie.
std::filesystem::path cluster_folder(const Store& store);

/// Writes submission.json; makes the folder if it is not there.
void write_submission(const Submission& submission);

/// Reads STORE/cluster/ID. Throws Error for a folder that is none.
Submission read_submission(const std::filesystem::path& folder);

/// All submissions of a store, oldest first; folders without submission.json (cut off while it was made) are not among
/// them.
std::vector<Submission> submissions(const Store& store);

/// The keys that need no more looking after: collected, or never to come.
std::vector<std::string> read_settled(const Submission& submission);
void write_settled(const Submission& submission, const std::vector<std::string>& keys);

/// Makes the folder of the next attempt at a job. Any number of processes may do so at once.
std::filesystem::path new_attempt(const Submission& submission, const std::string& key);

/// The folders of the attempts at a job, in their order.
std::vector<std::filesystem::path> attempt_folders(const Submission& submission, const std::string& key);

} // namespace tamp::cli
