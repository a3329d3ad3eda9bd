// Which jobs an agenda holds and which of them are still to be run.
#include "engine/base/error.h"
#include "engine/schedule/agenda.h"
#include "tests/engine/schedule/mock_run.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;

namespace {

Known known_from(std::map<std::string, Outcome> records) {
  return [records = std::move(records)](const std::string& key) {
    const auto found = records.find(key);
    return found == records.end() ? std::nullopt : std::optional(found->second);
  };
}

} // namespace

TEST_CASE("an agenda lists each generation and then its metrics") {
  const std::vector<Plan> plans{mock_plan("a", 3, 2)};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  REQUIRE(agenda.items.size() == 9);
  REQUIRE(agenda.count(Standing::open) == 9);
  for (std::size_t t = 0; t < 3; ++t) {
    const Item& generation = agenda.items[3 * t];
    CHECK(generation.key == "a" + std::to_string(t));
    CHECK_FALSE(generation.after);
    for (std::size_t m = 0; m < 2; ++m) {
      const Item& metric = agenda.items[3 * t + 1 + m];
      CHECK(metric.kind == JobKind::metric);
      CHECK(metric.after == 3 * t);
      CHECK(metric.key == metric_key(agenda.metric(metric), generation.key));
    }
  }
}

TEST_CASE("a job that two campaigns ask for is one job with the larger needs of both") {
  std::vector<Plan> plans{mock_plan("a", 2, 1), mock_plan("a", 3, 2)};
  plans[0].run = {.wall_s = 5, .memory_mb = 700, .timing = TimingMode::exclusive};
  plans[1].run = {.wall_s = 9, .memory_mb = 100, .timing = TimingMode::shared};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  REQUIRE(agenda.tasks.size() == 3);
  CHECK(agenda.items.size() == 3 + 3 * 2);
  CHECK(agenda.tasks[0].run.wall_s == 9);
  CHECK(agenda.tasks[0].run.memory_mb == 700);
  CHECK(agenda.tasks[0].run.timing == TimingMode::exclusive);
  CHECK(agenda.tasks[2].run.memory_mb == 100);
  CHECK(agenda.tasks[2].run.timing == TimingMode::shared);
}

TEST_CASE("what is recorded is not run again, and its missing metrics are") {
  const std::vector<Plan> plans{mock_plan("a", 2, 2)};
  const std::string measured = metric_key(plans[0].metrics[0], "a0");
  const Agenda agenda = make_agenda(plans, known_from({{"a0", Outcome::ok}, {measured, Outcome::ok}}));
  CHECK(agenda.items[0].standing == Standing::recorded);
  CHECK(agenda.items[1].standing == Standing::recorded);
  CHECK(agenda.items[2].standing == Standing::open);
  CHECK(agenda.items[3].standing == Standing::open);
  CHECK(recorded_outcomes(agenda)[static_cast<std::size_t>(Outcome::ok)] == 2);
}

TEST_CASE("nothing waits for a packing that is recorded not to exist") {
  Plan plan = mock_plan("a", 1, 2);
  plan.jobs.push_back(mock_job("child", "a0"));
  const std::vector<Plan> plans{plan};
  SECTION("because its job did not finish") {
    const Agenda agenda = make_agenda(plans, known_from({{"a0", Outcome::time_limited}}));
    CHECK(agenda.count(Standing::recorded) == 1);
    CHECK(agenda.count(Standing::barred) == agenda.items.size() - 1);
  }
  SECTION("while one that merely did not converge is measured") {
    const Agenda agenda = make_agenda(plans, known_from({{"a0", Outcome::did_not_converge}}));
    CHECK(agenda.count(Standing::open) == agenda.items.size() - 1);
  }
}

TEST_CASE("parents stand before their children, whatever the order of the file") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomStream random("parents", seed);
    const std::vector<Plan> plans{random_plan(random, "a"), random_plan(random, "b")};
    const Agenda agenda = make_agenda(plans, kNothingKnown);
    std::set<std::string> seen;
    std::size_t generations = 0;
    for (std::size_t i = 0; i < agenda.items.size(); ++i) {
      const Item& item = agenda.items[i];
      if (item.after)
        REQUIRE(*item.after < i);
      if (item.kind == JobKind::generation) {
        const std::string& parent = agenda.task(item).planned.job.parent;
        REQUIRE((parent.empty() || seen.contains(parent)));
        seen.insert(item.key);
        ++generations;
      }
    }
    REQUIRE(generations == plans[0].jobs.size() + plans[1].jobs.size());
  }
}

TEST_CASE("a parent from outside the campaign must be recorded with a packing") {
  Plan plan;
  plan.jobs.push_back(mock_job("child", "elsewhere"));
  const std::vector<Plan> plans{plan};
  CHECK_THROWS_AS(make_agenda(plans, kNothingKnown), Error);
  CHECK_THROWS_AS(make_agenda(plans, known_from({{"elsewhere", Outcome::failed}})), Error);
  CHECK(make_agenda(plans, known_from({{"elsewhere", Outcome::ok}})).count(Standing::open) == 1);
}
