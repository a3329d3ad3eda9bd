// Why a job would run again: the nearest recorded job, and what the command says of campaigns and keys.
#include "campaigns/cli/explain.h"
#include "engine/base/error.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::cli;
using namespace tamp::test;
using Catch::Contains;

TEST_CASE("differences name each leaf, also one that only one job states; a list is one value") {
  const Leaves recorded = leaves_of(R"({"kind":"generation","scene":{"psd":{"edges":[1,2]},"size":[40,40]},"seed":1})");
  const Leaves wanted = leaves_of(R"({"kind":"generation","scene":{"psd":{"edges":[1,3]},"size":[40,40]},"wet":true})");
  const auto found = differences(recorded, wanted);
  CHECK(in_words(found) == "scene/psd/edges: [1,2] recorded, [1,3] wanted; seed: 1 recorded, not stated wanted; "
                           "wet: not stated recorded, true wanted");
  CHECK(differences(recorded, recorded).empty());
  CHECK_THROWS_AS(leaves_of("[1]"), Error);
  CHECK_THROWS_AS(leaves_of("{\"a\":"), Error);
}

TEST_CASE("the nearest job has the fewest differences; of equally near ones the revision is told first") {
  const auto job = [](int revision, double size, int replicate) {
    return Leaves{{"method/revision", std::to_string(revision)},
                  {"scene/size", std::to_string(size)},
                  {"replicate", std::to_string(replicate)}};
  };
  const Leaves wanted = job(2, 40, 0);
  CHECK(nearest_job(std::vector{job(2, 50, 1), job(2, 50, 0), job(1, 50, 0)}, wanted) == 1U);
  CHECK(nearest_job(std::vector{job(2, 40, 1), job(1, 40, 0), job(2, 50, 0)}, wanted) == 1U);
  CHECK(nearest_job(std::vector{job(2, 40, 1), job(2, 50, 0)}, wanted) == 1U);
  CHECK_FALSE(nearest_job({}, wanted));
}

TEST_CASE("explain names the parameter that changed, a missing packing, and leaves the store alone") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 2, R"(, "metrics": ["phi"])"));
  CHECK_THAT(shop.tamp("explain discs.json").out,
             Contains("nothing of drop-and-roll is recorded") && Contains("2 metrics wait"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const auto before = digests(shop.folder() / "tamp-store" / "packings");
  CHECK(shop.tamp("explain discs.json").out == "4 of 4 jobs are recorded (4 ok) and do not run again\n");

  shop.write("wider.json", disc_campaign(21, 1, R"(, "metrics": ["phi"])"));
  CHECK_THAT(shop.tamp("explain wider.json").out,
             Contains("scene/size: [20,20] recorded, [21,21] wanted\n") || Contains("scene/size: [20.0,20.0] recorded, "
                                                                                    "[21.0,21.0] wanted\n"));
  shop.write("more.json", disc_campaign(20, 3, R"(, "metrics": ["phi"])"));
  CHECK_THAT(shop.tamp("explain more.json").out,
             Contains("replicate: ") && Contains(" recorded, 2 wanted\n") && Contains("4 of 6 jobs are recorded"));
  shop.write("finer.json", disc_campaign(20, 1, R"(, "metrics": ["phi", "overlap"])"));
  CHECK_THAT(shop.tamp("explain finer.json").out, Contains("runs: nothing of overlap is recorded"));

  const std::string file = before.begin()->first;
  const std::string key = fs::path(file).stem().string();
  CHECK_THAT(shop.tamp("explain " + key.substr(0, 16)).out,
             Contains(key) && Contains("does not run again: recorded as ok"));
  CHECK(digests(shop.folder() / "tamp-store" / "packings") == before);
  fs::remove(shop.folder() / "tamp-store" / "packings" / file);
  CHECK_THAT(shop.tamp("explain " + key).out, Contains("its packing is missing"));
  CHECK_THAT(shop.tamp("explain discs.json").out, Contains("runs again: recorded as ok, but its packing is missing"));

  const Said unknown = shop.tamp("explain 00nokey");
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("no keys in tamp-store begin so"));
}
