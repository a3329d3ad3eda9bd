// tamp timeline through the real command.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

using namespace tamp::test;
using Catch::Contains;

TEST_CASE("the timeline of a campaign shows its jobs and metrics, those that failed too") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 2, R"(, "metrics": ["phi"])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const Said said = shop.tamp("timeline discs.json --out t.svg");
  CAPTURE(said.err);
  REQUIRE(said.code == 0);
  CHECK(said.out == "t.svg\n");
  CHECK_THAT(tamp::read_file(shop.folder() / "t.svg"),
             Contains(": 4 jobs, at most ") && Contains("phi of drop-and-roll, replicate 1: ok, "));
  shop.write("other.json", disc_campaign(30, 2));
  CHECK(shop.tamp("timeline other.json --out o.svg").code == 2); // nothing of it has run
}
