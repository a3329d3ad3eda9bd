// Whole runs of the task graph with a mock in place of child processes.
#include "engine/base/host.h"
#include "engine/schedule/schedule.h"
#include "tests/engine/schedule/mock_run.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <numeric>

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr std::uint64_t kMb = 1'000'000;
constexpr auto kOk = static_cast<std::size_t>(Outcome::ok);
constexpr auto kFailed = static_cast<std::size_t>(Outcome::failed);

Resources resources(int cores) {
  return {.cores = cores, .memory_bytes = 100 * kMb};
}

std::size_t total(const OutcomeCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

} // namespace

TEST_CASE("random campaigns keep every promise and find the same on any number of cores") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    std::map<std::string, double> reference;
    for (const int cores : {1, 2, 5}) {
      RandomStream random("random campaigns", seed);
      const std::vector<Plan> plans{random_plan(random, "a"), random_plan(random, "x"), random_plan(random, "b")};
      const Agenda agenda = make_agenda(plans, kNothingKnown);
      MockRun run(resources(cores));
      run.duration = std::chrono::microseconds(random.below(50));
      const Summary summary = run(agenda);

      CAPTURE(seed, cores);
      REQUIRE(run.broken() == std::set<std::string>{});
      REQUIRE(summary.cancelled == 0);
      REQUIRE(total(summary.ran) == run.records().size());
      REQUIRE(total(summary.ran) + summary.barred == agenda.items.size());
      REQUIRE(summary.all_ok() == (summary.barred == 0 && summary.ran[kFailed] == 0));
      REQUIRE(run.events.size() == 2 * run.records().size() + summary.barred);
      if (cores == 1)
        reference = run.values();
      REQUIRE(run.values() == reference);
    }
  }
}

TEST_CASE("shared jobs do run side by side") {
  const std::vector<Plan> plans{mock_plan("a", 12, 1)};
  MockRun run(resources(3));
  run.duration = std::chrono::milliseconds(3);
  run(make_agenda(plans, kNothingKnown));
  CHECK(run.most_at_once() >= 2);
  CHECK(run.broken().empty());
}

TEST_CASE("metrics run while generations wait") {
  // One core token is held by a generation that waits until both metrics of the other packing are stored.
  Plan plan = mock_plan("a", 2, 2);
  const std::vector<Plan> plans{plan};
  const Agenda agenda = make_agenda(plans, kNothingKnown);

  class Waiting final : public Executor {
  public:
    std::atomic<int> metrics = 0;
    std::optional<Record> run(const Task& task, std::optional<int>, std::stop_token) override {
      const double patience = steady_seconds() + 20;
      while (task.planned.key == "a1" && metrics < 2 && steady_seconds() < patience)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      Record record;
      record.key = task.planned.key;
      record.outcome = task.planned.key == "a1" && metrics < 2 ? Outcome::failed : Outcome::ok;
      return record;
    }
  } executor;
  Observer observer;
  const Summary summary = run_agenda(agenda, resources(2),
                                     {.executor = executor,
                                      .measure =
                                          [&](const Task& task, const Metric& metric) {
                                            Record record;
                                            record.key = metric_key(metric, task.planned.key);
                                            record.outcome = Outcome::ok;
                                            ++executor.metrics;
                                            return record;
                                          },
                                      .sink = [](const Record&) {},
                                      .observer = observer});
  CHECK(summary.all_ok());
}

TEST_CASE("a failure stays with its job and what stands on it") {
  const std::vector<Plan> plans{mock_plan("x", 64, 2)};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  std::size_t bad = 0;
  for (const Task& task : agenda.tasks)
    bad += MockRun::outcome_of(task.planned.key) == Outcome::failed ? 1 : 0;
  REQUIRE(bad > 0);
  REQUIRE(bad < 64);

  MockRun run(resources(2));
  const Summary summary = run(agenda);
  CHECK(summary.ran[kFailed] == bad);
  CHECK(summary.barred == 2 * bad);
  CHECK(summary.ran[kOk] == 3 * (64 - bad));
  CHECK_FALSE(summary.all_ok());
  CHECK(run.broken().empty());
}

TEST_CASE("running again runs nothing") {
  const std::vector<Plan> plans{mock_plan("x", 40, 2)};
  MockRun first(resources(2));
  first(make_agenda(plans, kNothingKnown));
  std::map<std::string, Outcome> store;
  for (const Record& record : first.records())
    store[record.key] = record.outcome;

  const Known known = [&](const std::string& key) {
    return store.contains(key) ? std::optional(store.at(key)) : std::nullopt;
  };
  MockRun second(resources(2));
  const Summary summary = second(make_agenda(plans, known));
  CHECK(second.records().empty());
  CHECK(total(summary.ran) == 0);
  CHECK(total(summary.recorded) == first.records().size());
  CHECK(summary.cancelled == 0);
}

TEST_CASE("cancelling ends what runs and starts nothing more") {
  const std::vector<Plan> plans{mock_plan("a", 200, 3)};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  std::stop_source stop;
  MockRun run(resources(2));
  run.wait_for_stop = true;
  const std::jthread canceller([&] {
    while (run.generations_running < 2)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    stop.request_stop();
  });
  const Summary summary = run(agenda, stop.get_token());
  CHECK(run.generations_running == 2);
  CHECK(run.records().empty());
  CHECK(summary.cancelled == agenda.items.size());
  CHECK_FALSE(summary.all_ok());
}

TEST_CASE("cancelling in the middle keeps what is whole") {
  for (std::size_t after : {1U, 7U, 50U, 399U}) {
    const std::vector<Plan> plans{mock_plan("a", 100, 3)};
    const Agenda agenda = make_agenda(plans, kNothingKnown);
    std::stop_source stop;
    MockRun run(resources(2));
    std::size_t put = 0;
    run.before_put = [&](const Record&) {
      if (++put == after)
        stop.request_stop();
    };
    const Summary summary = run(agenda, stop.get_token());
    CAPTURE(after);
    CHECK(run.broken().empty());
    CHECK(run.records().size() >= after);
    CHECK(run.records().size() <= after + 2);
    CHECK(summary.cancelled + run.records().size() == agenda.items.size());
  }
}

TEST_CASE("an exception of the executor or of the sink ends the run and comes out") {
  const std::vector<Plan> plans{mock_plan("a", 50, 2)};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  MockRun run(resources(2));
  SECTION("executor") {
    run.throw_at = "a20";
    CHECK_THROWS_WITH(run(agenda), "no process can be started");
  }
  SECTION("sink") {
    run.before_put = [](const Record& record) {
      if (record.key == "a20")
        throw std::runtime_error("disk full");
    };
    CHECK_THROWS_WITH(run(agenda), "disk full");
  }
  CHECK(run.records().size() < agenda.items.size());
}

TEST_CASE("waiting for a long job costs no CPU time, or it would disturb exclusive timing") {
  Plan plan = mock_plan("a", 1, 0);
  plan.run.timing = TimingMode::exclusive;
  const std::vector<Plan> plans{plan};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  MockRun run(resources(2));
  run.duration = std::chrono::milliseconds(600);
  const double before = process_cpu_seconds();
  run(agenda);
  CHECK(process_cpu_seconds() - before < 0.2 * 0.6);
}

TEST_CASE("the scheduler costs little beside its jobs") {
  constexpr std::size_t kJobs = 10'000;
  const std::vector<Plan> plans{mock_plan("a", kJobs, 0)};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  MockRun run(resources(2));
  const double start = steady_seconds();
  run(agenda);
  const double per_job = (steady_seconds() - start) / static_cast<double>(kJobs);
  WARN(fmt::format("{} trivial jobs: {:.1f} us a job", kJobs, 1e6 * per_job));
  CHECK(run.records().size() == kJobs);
  CHECK(per_job < 1e-3); // starting a child process costs more than that
}
