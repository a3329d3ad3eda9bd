// Records run again: what agrees, what was changed behind the program's back, and what cannot be run.
#include "tests/campaigns/cli/tamp_command.h"

#include <SQLiteCpp/Database.h>
#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

TEST_CASE("a packing and its metrics are reproduced to the byte, and a changed number is told") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(20, 1, R"(, "metrics": ["phi"])"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  const fs::path store = shop.folder() / "tamp-store";
  const auto packings = digests(store / "packings");
  const std::string key = fs::path(packings.begin()->first).stem().string();

  const Said fine = shop.tamp("reproduce " + key.substr(0, 12));
  CHECK(fine.code == 0);
  CHECK_THAT(fine.out, Contains(key) && Contains("reproduced: all ") && Contains("the same bytes"));
  CHECK(digests(store / "packings") == packings);
  std::string metric;
  for (const auto& [name, row] : shop.results("tamp-store")) {
    if (name != key)
      metric = name;
  }
  if (!metric.empty())
    CHECK(shop.tamp("reproduce " + metric).code == 0);

  {
    SQLite::Database database((store / "tamp.sqlite").string(), SQLite::OPEN_READWRITE);
    REQUIRE(database.exec("UPDATE measures SET value = value + 1 WHERE name = 'phi'") > 0);
  }
  const Said changed = shop.tamp("reproduce " + key);
  CHECK(changed.code == 1);
  CHECK_THAT(changed.out, Contains("phi: ") && Contains("not reproduced: "));

  CHECK(shop.tamp("reproduce 0000000000000000").code == 2);
}
