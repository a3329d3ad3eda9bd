// Takes the results of submissions into the store, and judges the jobs that left none.
#pragma once

#include "campaigns/cli/submission.h"
#include "engine/schedule/slurm_state.h"

#include <chrono>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tamp::cli {

/// What one look at a submission has found.
struct Collected {
  std::vector<Record> records;         ///< that are new in the store
  std::vector<std::string> complaints; ///< results that are damaged
  std::size_t open = 0;                ///< jobs that may still come, or whose results could not be taken in
  std::size_t refused = 0;             ///< the latter of them
  bool settling = false;               ///< some of them are gone without a result, for too short a time to judge
};

/// Looks after one submission; remembers since when elements have been gone.
class Collector {
public:
  explicit Collector(Submission submission) : submission_(std::move(submission)) {}

  [[nodiscard]] const Submission& submission() const { return submission_; }

  /// Imports every result that is there; the caller holds the store's lock. The result file alone decides; `states`
  /// explains its absence. Call it with states asked for before, never with those of a failed call.
  Collected look(Store& store, const ElementStates& states);

  /// Whether every job is settled.
  [[nodiscard]] bool done() const { return open_ == 0; }

private:
  struct Place {
    std::size_t array;
    int element;
  };
  enum class Import { none, taken, refused };
  Import import(Store& store, const std::string& key, Collected& collected);
  void judge(Store& store, const std::string& key, const Place& place, const ElementStates& states,
             Collected& collected);
  std::string last_word(const Place& place, const ElementStates& states);

  Submission submission_;
  std::size_t open_ = 1;
  std::map<std::pair<std::size_t, int>, std::chrono::steady_clock::time_point> gone_since_;
  std::map<std::size_t, ElementStates> accounted_; ///< by array, asked once
};

} // namespace tamp::cli
