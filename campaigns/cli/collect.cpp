// Results first, Slurm's words second.
#include "campaigns/cli/collect.h"

#include "campaigns/cli/provenance.h"
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/schedule/slurm.h"
#include "store/record_json.h"

#include <fmt/format.h>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kTail = 2000; ///< bytes of a log that go into a reason

std::string tail(const fs::path& file) {
  if (!fs::exists(file))
    return {};
  const std::string text = read_file(file);
  return text.size() <= kTail ? text : text.substr(text.size() - kTail);
}

} // namespace

Collected Collector::look(Store& store, const ElementStates& states) {
  Collected collected;
  const std::vector<std::string> before = read_settled(submission_);
  std::set<std::string> settled(before.begin(), before.end());
  for (std::size_t a = 0; a < submission_.arrays.size(); ++a) {
    const SubmittedArray& array = submission_.arrays[a];
    for (std::size_t e = 0; e < array.elements.size(); ++e) {
      const Place place{a, static_cast<int>(e)};
      for (const std::string& key : array.elements[e]) {
        if (settled.contains(key))
          continue;
        const std::size_t open = collected.open;
        const Import how = import(store, key, collected);
        if (how == Import::refused) {
          ++collected.open;
          ++collected.refused;
        } else if (how == Import::none) {
          judge(store, key, place, states, collected);
        }
        if (collected.open == open)
          settled.insert(key);
      }
    }
  }
  if (settled.size() != before.size())
    write_settled(submission_, {settled.begin(), settled.end()});
  open_ = collected.open;
  return collected;
}

/// refused: of the results that were there, one at least is there still.
Collector::Import Collector::import(Store& store, const std::string& key, Collected& collected) {
  Import how = Import::none;
  for (const fs::path& attempt : attempt_folders(submission_, key)) {
    const fs::path result = attempt / "result.json";
    if (!fs::exists(result))
      continue;
    if (how == Import::none)
      how = Import::taken;
    try {
      Record record = store.import_result(result, attempt / (key + ".h5"));
      const bool first = collected.records.empty() || collected.records.back().key != key;
      if (first) {
        store.keep_log(key, attempt / "log");
        collected.records.push_back(std::move(record));
      }
    } catch (const Error& e) {
      // The disk may have failed, and the result be good: it stays where it is, and the next look tries again.
      how = Import::refused;
      collected.complaints.push_back(fmt::format("{}: {}", attempt.string(), e.what()));
    }
  }
  return how;
}

/// Slurm's last word on an element; empty if it has none.
std::string Collector::last_word(const Place& place, const ElementStates& states) {
  const SubmittedArray& array = submission_.arrays[place.array];
  const std::pair element{array.name, place.element};
  if (const auto found = states.find(element); found != states.end())
    return found->second;
  if (array.number.empty()) // the answer to its submission got lost
    return {};
  auto accounted = accounted_.find(place.array);
  if (accounted == accounted_.end()) // the rare case: one more call, once for the array
    accounted = accounted_.emplace(place.array, accounted_states({array.number})).first;
  const auto found = accounted->second.find(element);
  return found != accounted->second.end() ? found->second : "";
}

void Collector::judge(Store& store, const std::string& key, const Place& place, const ElementStates& states,
                      Collected& collected) {
  const SubmittedArray& array = submission_.arrays[place.array];
  const auto state = states.find({array.name, place.element});
  if (state != states.end() && !is_over(state->second)) {
    gone_since_.erase({place.array, place.element}); // also one that has been put into the queue again
    ++collected.open;
    return;
  }
  // The file system of the nodes may be slower than the queue, and a controller just restarted know less than before.
  const auto now = Clock::now();
  const auto since = gone_since_.emplace(std::pair{place.array, place.element}, now).first->second;
  if (std::chrono::duration<double>(now - since).count() < submission_.settle_s) {
    ++collected.open;
    collected.settling = true;
    return;
  }
  // An earlier look that was cut off may have imported it.
  if (const auto known = store.find(key); known && known->provenance.end_utc >= submission_.created_utc)
    return;
  const Job job = read_job(read_file(submission_.job_file(key)));
  if (!job.parent.empty() && !fs::exists(store.packing_path(job.parent)))
    return; // rightly not run: there was nothing to start from
  const std::string log = tail(submission_.logs() / fmt::format("{}_{}.log", array.name, place.element));
  const bool begun = !attempt_folders(submission_, key).empty();
  Verdict verdict = explain_absence(last_word(place, states), log);
  if (!begun && verdict.outcome != Outcome::cancelled) {
    verdict.outcome = Outcome::lost;
    verdict.reason = "never started: its element " + verdict.reason;
  }
  Record record = blank_record({.job = job, .key = key, .label = {}, .point = {}}, this_program());
  record.outcome = verdict.outcome;
  record.reason = verdict.reason;
  record.provenance.start_utc = submission_.created_utc;
  record.provenance.end_utc = utc_now();
  record.timing.mode = array.run.timing;
  record.limits = limits_of(array.run);
  store.put(record);
  collected.records.push_back(std::move(record));
}

} // namespace tamp::cli
