// When a time counts as disturbed.
#include "engine/schedule/disturbance.h"

#include <catch2/catch.hpp>

using namespace tamp;
using Catch::Contains;

TEST_CASE("an exclusive time is disturbed if its core was elsewhere for more than a few percent of it") {
  const auto judged = [](TimingMode mode, double wall_s, double cpu_s, double steal_s) {
    Timing timing{.mode = mode, .wall_s = wall_s, .cpu_s = cpu_s};
    timing.conditions.steal_s = steal_s;
    settle_time(timing);
    return timing.conditions.disturbed;
  };
  using enum TimingMode;
  CHECK(judged(exclusive, 10, 9.9, 0).empty());
  CHECK_THAT(judged(exclusive, 10, 9.5, 0), Contains("off its core for 0.5 s of 10 s"));
  CHECK_THAT(judged(exclusive, 10, 10, 0.2), Contains("hypervisor took 0.2 s"));
  CHECK(judged(exclusive, 10, 10, 0.05).empty());
  CHECK(judged(shared, 10, 2, 3).empty());
  CHECK(judged(exclusive, 0.005, 0.001, 0).empty()); // what a clock of such short times can tell
  CHECK_FALSE(judged(exclusive, 0.05, 0.02, 0).empty());
  CHECK(judged(exclusive, 10, 12, 0).empty());
}

TEST_CASE("of several times the median of those that were not disturbed counts") {
  Timing timing{.mode = TimingMode::exclusive};
  for (const double wall_s : {1.0, 1.1, 1.04, 2.0, 1.5})
    timing.samples.push_back({wall_s, wall_s > 1.2 ? 1.02 : wall_s, 0, 0, ""});
  settle_time(timing);
  CHECK(timing.wall_s == 1.04);
  CHECK(timing.cpu_s == 1.04);
  CHECK(timing.conditions.disturbed.empty());
  CHECK(timing.samples[2].disturbed.empty());
  CHECK_THAT(timing.samples[3].disturbed, Contains("off its core for 0.98 s of 2 s"));

  SECTION("of an even number the mean of the middle two") {
    timing.samples.pop_back();
    timing.samples[3].cpu_s = 2;
    settle_time(timing);
    CHECK(timing.wall_s == Approx(1.07));
  }
  SECTION("if all were disturbed, all count, but the time is marked") {
    for (TimeSample& sample : timing.samples)
      sample.cpu_s = 0.5;
    settle_time(timing);
    CHECK(timing.wall_s == 1.1);
    CHECK_THAT(timing.conditions.disturbed, Contains("each time") && Contains("off its core"));
  }
  SECTION("of shared times nothing is expected") {
    timing.mode = TimingMode::shared;
    settle_time(timing);
    CHECK(timing.wall_s == 1.1);
    CHECK(timing.samples[3].disturbed.empty());
  }
}
