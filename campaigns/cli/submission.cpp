// Submissions as JSON files in a folder of the store.
#include "campaigns/cli/submission.h"

#include "engine/base/error.h"
#include "engine/base/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSubmission = "submission.json";
constexpr const char* kSettled = "settled.json";

json to_json(const SubmittedArray& array) {
  return {{"name", array.name},           {"number", array.number},           {"wall_s", array.run.wall_s},
          {"cpu_s", array.run.cpu_s},     {"memory_mb", array.run.memory_mb}, {"timing", name_of(array.run.timing)},
          {"samples", array.run.samples}, {"elements", array.elements}};
}

SubmittedArray array_from(const json& object) {
  SubmittedArray array;
  array.name = object.at("name");
  array.number = object.at("number");
  array.run.wall_s = object.at("wall_s");
  array.run.cpu_s = object.value("cpu_s", 0.); // not in the submissions of older programs, as `samples`
  array.run.memory_mb = object.at("memory_mb");
  array.run.timing = enum_of<TimingMode>(object.at("timing").get<std::string>()).value();
  array.run.samples = object.value("samples", std::int64_t{1});
  array.elements = object.at("elements").get<std::vector<std::vector<std::string>>>();
  return array;
}

} // namespace

fs::path cluster_folder(const Store& store) {
  return fs::absolute(store.folder()) / "cluster";
}

void write_submission(const Submission& submission) {
  std::error_code error;
  fs::create_directories(submission.logs(), error);
  if (error)
    throw Error(fmt::format("cannot make the folder {}: {}", submission.logs().string(), error.message()));
  json arrays = json::array();
  for (const SubmittedArray& array : submission.arrays)
    arrays.push_back(to_json(array));
  std::vector<std::string> files;
  for (const fs::path& file : submission.campaigns)
    files.push_back(file.string());
  const json object = {{"created_utc", submission.created_utc},
                       {"campaigns", files},
                       {"settle_s", submission.settle_s},
                       {"arrays", arrays}};
  write_atomically(submission.folder / kSubmission, object.dump(1));
}

Submission read_submission(const fs::path& folder) {
  try {
    const json object = json::parse(read_file(folder / kSubmission));
    Submission submission;
    submission.folder = folder;
    submission.created_utc = object.at("created_utc");
    for (const std::string file : object.at("campaigns"))
      submission.campaigns.emplace_back(file);
    submission.settle_s = object.at("settle_s");
    for (const json& array : object.at("arrays"))
      submission.arrays.push_back(array_from(array));
    return submission;
  } catch (const std::exception& e) {
    throw Error(fmt::format("{} is no submission: {}", folder.string(), e.what()));
  }
}

std::vector<Submission> submissions(const Store& store) {
  std::set<fs::path> folders;
  if (fs::exists(cluster_folder(store))) {
    for (const auto& entry : fs::directory_iterator(cluster_folder(store))) {
      if (fs::exists(entry.path() / kSubmission))
        folders.insert(entry.path());
    }
  }
  std::vector<Submission> found;
  for (const fs::path& folder : folders)
    found.push_back(read_submission(folder));
  return found;
}

std::vector<std::string> read_settled(const Submission& submission) {
  const fs::path file = submission.folder / kSettled;
  return fs::exists(file) ? json::parse(read_file(file)).get<std::vector<std::string>>() : std::vector<std::string>{};
}

void write_settled(const Submission& submission, const std::vector<std::string>& keys) {
  write_atomically(submission.folder / kSettled, json(keys).dump(0));
}

fs::path new_attempt(const Submission& submission, const std::string& key) {
  const fs::path above = submission.attempts(key);
  std::error_code error;
  fs::create_directories(above, error);
  for (int number = 1; !error; ++number) {
    // Tells whether it was this process that made it.
    if (fs::path folder = above / std::to_string(number); fs::create_directory(folder, error))
      return folder;
  }
  throw Error(fmt::format("cannot make a folder in {}: {}", above.string(), error.message()));
}

std::vector<fs::path> attempt_folders(const Submission& submission, const std::string& key) {
  std::vector<fs::path> folders;
  for (int number = 1;; ++number) {
    fs::path folder = submission.attempts(key) / std::to_string(number);
    if (!fs::exists(folder))
      return folders;
    folders.push_back(std::move(folder));
  }
}

} // namespace tamp::cli
