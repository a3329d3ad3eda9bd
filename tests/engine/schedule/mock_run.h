// Plans with invented keys and a mock executor that checks, while it runs, what the scheduler promises.
#pragma once

#include "engine/base/random.h"
#include "engine/schedule/schedule.h"

#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace tamp::test {

inline const Known kNothingKnown = [](const std::string&) { return std::optional<Outcome>(); };

/// The first n metrics of the enumeration.
inline std::vector<Metric> some_metrics(std::size_t n) {
  std::vector<Metric> metrics(n);
  for (std::size_t m = 0; m < n; ++m)
    metrics[m].name = static_cast<MetricName>(m);
  return metrics;
}

inline PlannedJob mock_job(const std::string& key, const std::string& parent = {}) {
  PlannedJob planned;
  planned.key = key;
  planned.job.parent = parent;
  return planned;
}

/// A plan of n jobs "<prefix>0", "<prefix>1", … without parents.
inline Plan mock_plan(const std::string& prefix, std::size_t n, std::size_t metrics) {
  Plan plan;
  plan.run.memory_mb = 1;
  plan.metrics = some_metrics(metrics);
  for (std::size_t i = 0; i < n; ++i)
    plan.jobs.push_back(mock_job(prefix + std::to_string(i)));
  return plan;
}

/// A plan whose jobs may start from any earlier job, then shuffled.
inline Plan random_plan(RandomStream& random, const std::string& prefix) {
  const std::size_t n = 1 + random.below(40);
  Plan plan = mock_plan(prefix, n, random.below(4));
  plan.run.memory_mb = static_cast<std::int64_t>(1 + random.below(50));
  plan.run.timing = random.below(2) == 0 ? TimingMode::shared : TimingMode::exclusive;
  for (std::size_t i = 1; i < n; ++i) {
    if (random.below(3) == 0)
      plan.jobs[i].job.parent = plan.jobs[random.below(i)].key;
  }
  for (std::size_t i = n; i-- > 1;)
    std::swap(plan.jobs[i], plan.jobs[random.below(i + 1)]);
  return plan;
}

/// Counts what runs at the same time; a broken promise is kept as text, since assertions belong to the main thread.
class Watch {
public:
  explicit Watch(const Resources& resources) : resources_(resources) {}

  class Running {
  public:
    Running(Watch& watch, bool exclusive, std::uint64_t memory)
        : watch_(watch), exclusive_(exclusive), memory_(memory) {
      watch_.change(1, exclusive_, memory_);
    }
    ~Running() { watch_.change(-1, exclusive_, memory_); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

  private:
    Watch& watch_;
    bool exclusive_;
    std::uint64_t memory_;
  };

  [[nodiscard]] std::set<std::string> broken() const { return broken_; }
  [[nodiscard]] int most_at_once() const { return most_; }

private:
  void change(int by, bool exclusive, std::uint64_t memory) {
    const std::scoped_lock lock(mutex_);
    running_ += by;
    exclusive_ += exclusive ? by : 0;
    memory_ += by > 0 ? memory : std::uint64_t{0} - memory;
    most_ = std::max(most_, running_);
    if (exclusive_ > 0 && running_ > 1)
      broken_.insert("an exclusive job was not alone");
    if (running_ > resources_.cores)
      broken_.insert("more jobs than cores");
    if (memory_ > resources_.memory_bytes && running_ > 1)
      broken_.insert("more memory than there is");
  }

  const Resources& resources_;
  std::mutex mutex_;
  int running_ = 0;
  int exclusive_ = 0;
  std::uint64_t memory_ = 0;
  int most_ = 0;
  std::set<std::string> broken_;
};

/// Runs an agenda with made-up results: outcome and measures depend on the key alone, as those of real jobs do.
class MockRun final : public Executor, public Observer {
public:
  explicit MockRun(Resources resources) : resources_(resources), watch_(resources_) {}

  std::chrono::microseconds duration{0};
  bool wait_for_stop = false; ///< generations end only by cancellation
  std::string throw_at;       ///< key whose executor throws
  std::function<void(const Record&)> before_put = [](const Record&) {};

  Summary operator()(const Agenda& agenda, const std::stop_token& stop = {}) {
    return run_agenda(agenda, resources_,
                      {.executor = *this,
                       .measure = [this](const Task& task, const Metric& metric) { return measure(task, metric); },
                       .sink = [this](const Record& record) { put(record); },
                       .observer = *this},
                      stop);
  }

  std::optional<Record> run(const Task& task, std::optional<int> core, std::stop_token stop) override {
    const bool exclusive = task.run.timing == TimingMode::exclusive;
    const Watch::Running running(watch_, exclusive, memory_bytes(task.run));
    ++generations_running;
    if (exclusive != core.has_value())
      note("exclusive jobs, and no others, are pinned");
    if (task.planned.key == throw_at)
      throw std::runtime_error("no process can be started");
    while (wait_for_stop && !stop.stop_requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (stop.stop_requested())
      return std::nullopt;
    std::this_thread::sleep_for(duration);
    return made_up(task.planned.key, JobKind::generation, "");
  }

  /// Records in the order in which they reached the sink.
  [[nodiscard]] const std::vector<Record>& records() const { return records_; }
  [[nodiscard]] std::map<std::string, double> values() const {
    std::map<std::string, double> out;
    for (const Record& record : records_)
      out[record.key] = record.measures.at(0).value;
    return out;
  }
  [[nodiscard]] std::set<std::string> broken() const {
    std::set<std::string> all = watch_.broken();
    all.insert(broken_.begin(), broken_.end());
    return all;
  }
  [[nodiscard]] int most_at_once() const { return watch_.most_at_once(); }
  std::atomic<int> generations_running = 0; ///< that have started

  std::vector<std::string> events; ///< what the observer saw
  void started(const Item& item) override { events.push_back("started " + item.key); }
  void finished(const Item& item, const Record&) override { events.push_back("finished " + item.key); }
  void barred(const Item& item) override { events.push_back("barred " + item.key); }

  /// Outcome of a generation: one in eight keys that start with 'x' (bad) fails.
  static Outcome outcome_of(const std::string& key) {
    return key.front() == 'x' && RandomStream(key, 1).below(8) == 0 ? Outcome::failed : Outcome::ok;
  }

private:
  Record measure(const Task& task, const Metric& metric) {
    const Watch::Running running(watch_, false, 0);
    std::this_thread::sleep_for(duration);
    const std::scoped_lock lock(mutex_);
    if (!put_.contains(task.planned.key))
      broken_.insert("a packing was measured before it was stored");
    return made_up(metric_key(metric, task.planned.key), JobKind::metric, task.planned.key);
  }

  void put(const Record& record) {
    if (putting_.exchange(true))
      note("two records reached the sink at once");
    before_put(record);
    records_.push_back(record);
    {
      const std::scoped_lock lock(mutex_);
      if (!put_.insert(record.key).second)
        broken_.insert("a job ran twice");
    }
    putting_ = false;
  }

  static Record made_up(const std::string& key, JobKind kind, const std::string& parent) {
    Record record;
    record.key = key;
    record.kind = kind;
    record.parent = parent;
    record.outcome = kind == JobKind::generation ? outcome_of(key) : Outcome::ok;
    record.measures = {{.name = "value", .value = RandomStream(key, 2).uniform()}};
    return record;
  }

  void note(const std::string& what) {
    const std::scoped_lock lock(mutex_);
    broken_.insert(what);
  }

  Resources resources_;
  Watch watch_;
  std::mutex mutex_;
  std::set<std::string> put_;
  std::set<std::string> broken_;
  std::vector<Record> records_;
  std::atomic<bool> putting_ = false;
};

} // namespace tamp::test
