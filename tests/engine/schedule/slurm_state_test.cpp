// Slurm's columns and words, as the versions of it print them.
#include "engine/schedule/slurm_state.h"

#include <catch2/catch.hpp>

using namespace tamp;

TEST_CASE("the queue is read element by element, whatever else stands in it") {
  const ElementStates states = parse_queue("tamp-x-0|3|RUNNING\n"
                                           "another|N/A|PENDING\n"
                                           "tamp-x-0|12|CANCELLED by 1000\n"
                                           "\n"
                                           "slurm_load_jobs error\n"
                                           "tamp-x-1|0|COMPLETED");
  CHECK(states.size() == 3);
  CHECK(states.at({"tamp-x-0", 3}) == "RUNNING");
  CHECK(states.at({"tamp-x-0", 12}) == "CANCELLED");
  CHECK(states.at({"tamp-x-1", 0}) == "COMPLETED");
}

TEST_CASE("the accounting is read where there is one") {
  const ElementStates states =
      parse_accounting("tamp-x-0|17_4|TIMEOUT\ntamp-x-0|17_[5-9]|CANCELLED by 0\nlone|18|FAILED\n");
  CHECK(states.size() == 1);
  CHECK(states.at({"tamp-x-0", 4}) == "TIMEOUT");
}

TEST_CASE("an element in a state that nobody knows is waited for") {
  for (const char* state : {"COMPLETED", "FAILED", "TIMEOUT", "NODE_FAIL", "OUT_OF_MEMORY", "CANCELLED", "PREEMPTED"})
    CHECK(is_over(state));
  for (const char* state : {"PENDING", "RUNNING", "COMPLETING", "REQUEUED", "SUSPENDED", "CONFIGURING", "NEW_WORD"})
    CHECK_FALSE(is_over(state));
}

TEST_CASE("Slurm's state explains why there is no result") {
  CHECK(explain_absence("TIMEOUT", "").outcome == Outcome::time_limited);
  CHECK(explain_absence("OUT_OF_MEMORY", "").outcome == Outcome::memory_limited);
  CHECK(explain_absence("CANCELLED", "").outcome == Outcome::cancelled);
  CHECK(explain_absence("NODE_FAIL", "").outcome == Outcome::lost);
  CHECK(explain_absence("", "").outcome == Outcome::lost);
  // Killed by -9 or for its memory: the state is the same, only the output tells.
  CHECK(explain_absence("FAILED", "").outcome == Outcome::lost);
  const Verdict verdict =
      explain_absence("FAILED", "slurmstepd: error: Step 3.batch exceeded memory limit (90 > 50), being killed\n");
  CHECK(verdict.outcome == Outcome::memory_limited);
  CHECK_THAT(verdict.reason, Catch::Contains("90 > 50"));
}
