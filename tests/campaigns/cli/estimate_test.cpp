// The guess of the remaining time, and times in words.
#include "campaigns/cli/estimate.h"
#include "tests/engine/schedule/mock_run.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;

TEST_CASE("remaining jobs are taken to last as long as those of their kind did") {
  Plan plan = mock_plan("a", 4, 1); // items: generation, metric, generation, metric, …
  for (PlannedJob& job : plan.jobs)
    job.label = "method";
  const std::vector<Plan> plans{plan};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  cli::Estimate estimate(agenda, 2);
  CHECK_FALSE(estimate.remaining_s());

  estimate.finished(agenda.items[0], 10);
  CHECK(estimate.remaining_s() == Approx(3 * 10 / 2.0 + 4 * 10 / 2.0)); // nothing is known of metrics yet
  estimate.finished(agenda.items[1], 2);
  CHECK(estimate.remaining_s() == Approx((3 * 10 + 3 * 2) / 2.0));
  estimate.finished(agenda.items[2], 20);
  CHECK(estimate.remaining_s() == Approx((2 * 15 + 3 * 2) / 2.0));
  estimate.barred(agenda.items[3]);
  CHECK(estimate.remaining_s() == Approx((2 * 15 + 2 * 2) / 2.0));
}

TEST_CASE("exclusive jobs come one after the other") {
  Plan plan = mock_plan("a", 3, 0);
  plan.run.timing = TimingMode::exclusive;
  const std::vector<Plan> plans{plan};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  cli::Estimate estimate(agenda, 8);
  estimate.finished(agenda.items[0], 5);
  CHECK(estimate.remaining_s() == Approx(10));
}

TEST_CASE("times in words") {
  CHECK(cli::in_words(0.2) == "1 s");
  CHECK(cli::in_words(59) == "59 s");
  CHECK(cli::in_words(600) == "10 min");
  CHECK(cli::in_words(3 * 3600 + 20 * 60) == "3 h 20 min");
}
