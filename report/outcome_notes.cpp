// Notes on jobs that did not end ok and on jobs that have not run.
#include "report/notes.h"

#include <fmt/format.h>

#include <map>

namespace tamp {

namespace {

/// More than this many jobs of one kind are counted, not listed: the rest is in the file of records.
constexpr std::size_t kListed = 8;

/// "1 job", "2 jobs".
std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

class List {
public:
  void add(const std::string& item) {
    if (count_++ < kListed)
      text_ += (text_.empty() ? "" : "; ") + item;
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::string text() const {
    return count_ > kListed ? fmt::format("{}; and {} more", text_, count_ - kListed) : text_;
  }

private:
  std::string text_;
  std::size_t count_ = 0;
};

std::string replicate_name(const RunGroup& group, const Run& run) {
  return fmt::format("{} replicate {}", group.heading, run.planned.job.replicate);
}

std::string reason_of(const Record& record) {
  return record.reason.empty() ? "no reason recorded" : record.reason;
}

} // namespace

std::vector<Note> outcome_notes(const NotesInput& input) {
  std::map<Outcome, List> ended; // generation jobs
  List metrics_ended;
  List missing;
  List impossible;
  bool limited = false;
  List metrics_missing;
  for (const RunGroup& group : input.groups) {
    for (const Run& run : group.runs) {
      const std::string who = replicate_name(group, run);
      if (const Ancestor* barrier = run.barrier(); !run.generation && barrier != nullptr) {
        impossible.add(fmt::format("{} ({}): {} ({}) ended {}", who, short_key(run.planned.key), barrier->label,
                                   short_key(barrier->key), name_of(*barrier->outcome)));
        limited = limited || *barrier->outcome == Outcome::time_limited || *barrier->outcome == Outcome::memory_limited;
        continue;
      }
      if (!run.generation) {
        missing.add(fmt::format("{} ({})", who, short_key(run.planned.key)));
        continue;
      }
      if (!run.ok()) {
        ended[run.generation->outcome].add(
            fmt::format("{} ({}): {}", who, short_key(run.planned.key), reason_of(*run.generation)));
        continue;
      }
      for (const MetricRun& metric : run.metrics) {
        const std::string what = fmt::format("{} of {} ({})", name_of(metric.metric.name), who, short_key(metric.key));
        if (!metric.record)
          metrics_missing.add(what);
        else if (metric.record->outcome != Outcome::ok)
          metrics_ended.add(
              fmt::format("{}: {}: {}", what, name_of(metric.record->outcome), reason_of(*metric.record)));
      }
    }
  }

  std::vector<Note> notes;
  if (input.groups.empty())
    notes.push_back({"No jobs", fmt::format("The campaign has no {}.", input.content)});
  for (const auto& [outcome, list] : ended) {
    notes.push_back({fmt::format("{} ended {}", counted(list.count(), "job"), name_of(outcome)),
                     "Not in the figures above. " + list.text() + "."});
  }
  if (metrics_ended.count() > 0)
    notes.push_back({counted(metrics_ended.count(), "metric") + " did not end ok", metrics_ended.text() + "."});
  if (impossible.count() > 0) {
    notes.push_back({counted(impossible.count(), "job") + " not possible",
                     "The packings to start from were not made: " + impossible.text() + "." +
                         (limited ? " With a raised budget: " + input.command + " --retry-limited" : "")});
  }
  if (missing.count() + metrics_missing.count() > 0) {
    std::string text =
        fmt::format("No record of {} and of {} on recorded packings.", counted(missing.count(), "generation job"),
                    counted(metrics_missing.count(), "metric"));
    for (const List* list : {&missing, &metrics_missing}) {
      if (list->count() > 0)
        text += " " + list->text() + ".";
    }
    notes.push_back({"Missing", text + " To run them: " + input.command});
  }
  return notes;
}

} // namespace tamp
