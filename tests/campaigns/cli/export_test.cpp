// tamp export through the real command: from the store, from format to format, and wrong requests.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

using namespace tamp::test;
using Catch::Contains;

TEST_CASE("a packing of the store is exported, converted and comes back to the same bytes") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 1));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const std::string key = shop.results("tamp-store").begin()->first;
  const Said said = shop.tamp("export " + key.substr(0, 8) + " --out bed.csv");
  CAPTURE(said.err);
  REQUIRE(said.code == 0);
  CHECK(said.out == "bed.csv\n");
  REQUIRE(shop.tamp("export bed.csv --out bed.dump").code == 0);
  REQUIRE(shop.tamp("export bed.dump --format h5 --out bed.h5").code == 0);
  REQUIRE(shop.tamp("export bed.h5 --format csv --out again").code == 0);
  CHECK((tamp::read_file(shop.folder() / "again") == tamp::read_file(shop.folder() / "bed.csv")));
}

TEST_CASE("a wrong export is answered with what is allowed, and writes nothing") {
  const Workshop shop(TAMP_BINARY);
  shop.write("bad.csv", "x,y,z,r\n1,1,1,1\n1,1,one,1\n");
  shop.write("good.csv", "x,y,z,r\n1,1,1,1\n");
  const auto before = digests(shop.folder());
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const Said said = shop.tamp("export " + arguments);
    CAPTURE(arguments, said.err);
    CHECK(said.code == 2);
    CHECK_THAT(said.err, Contains(message));
  };
  refused("bad.csv --out o.xyz", "bad.csv:3: z is \"one\"");
  refused("good.csv --out o.gif", "known are h5, csv");
  refused("good.csv --format gif --out o", "unknown format \"gif\"");
  refused("good.csv --unit inch --out o.xyz", "--unit inch");
  refused("good.csv --box 1,2,3,4,5 --out o.xyz", "--box");
  refused("good.csv --boundary sea --out o.xyz", "--boundary sea");
  refused("absent --out o.xyz", "there is no store");
  CHECK(digests(shop.folder()) == before);
}

TEST_CASE("a campaign is exported as RO-Crate, with a hint where the licence is missing") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 2, R"(, "metrics": ["phi"])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const Said said = shop.tamp("export discs.json --ro-crate --author 'A B <https://example.org/ab>' --out crate");
  CAPTURE(said.err);
  REQUIRE(said.code == 0);
  CHECK_THAT(said.out, Contains("crate: 2 packings, 4 runs, 0 of them not ok\n") && Contains("--license"));
  const std::string graph = tamp::read_file(shop.folder() / "crate/ro-crate-metadata.json");
  CHECK_THAT(graph, Contains(R"({"@id":"https://example.org/ab","@type":"Person","name":"A B"})"));
  CHECK(shop.tamp("export discs.json --ro-crate --out crate").code == 2);
  CHECK(shop.tamp("export discs.json --license MIT --out crate").code == 2);
}
