// Comparisons through the real command: stores, methods, what does not exist.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

using namespace tamp::test;
using Catch::Contains;

TEST_CASE("stores and methods are set side by side") {
  const Workshop shop(TAMP_BINARY);
  const auto campaign = [](int seed) {
    return fmt::format(R"({{"campaign": "chain", "scene": {{"dimension": 2, "size": 30, "psd": {{"law": "lognormal", )"
                       R"("mu_ln": 0, "sigma_ln": 0.5, "r_min": 0.3, "r_max": 4}}}}, "replicates": 3, "seed": {}, )"
                       R"("methods": [{{"name": "drop-and-roll", "label": "bed"}}, )"
                       R"({{"name": "drop-and-roll-me", "label": "denser", "from": "bed"}}, )"
                       R"({{"name": "drop-and-roll", "label": "kept", "on_failure": "keep"}}], "metrics": ["phi"]}})",
                       seed);
  };
  shop.write("one.json", campaign(1));
  shop.write("two.json", campaign(2));
  REQUIRE(shop.tamp("run one.json --store a").code == 0);
  REQUIRE(shop.tamp("run one.json --store b").code == 0);
  REQUIRE(shop.tamp("run two.json --store c").code == 0);

  const Said same = shop.tamp("compare a b");
  CHECK(same.code == 0);
  CHECK_THAT(same.out, Contains("same bytes") && Contains("0 tests") && !Contains("paired t"));
  CHECK_THAT(shop.tamp("compare a c").out, Contains("Welch t") && !Contains("same bytes"));

  const Said methods = shop.tamp("compare --by method bed denser --store a --format json");
  CAPTURE(methods.err);
  REQUIRE(methods.code == 0);
  const auto json = nlohmann::json::parse(methods.out);
  bool has_phi = false;
  for (const auto& row : json.at("quantities")) {
    if (row.at("quantity") != "phi")
      continue;
    has_phi = true;
    CHECK(row.at("by") == "paired t");
    CHECK(row.at("difference").get<double>() > 0);
    CHECK(row.at("n_a") == 3);
  }
  CHECK(has_phi);
  // The same seed and replicate, but radii drawn for another job: nothing is shared.
  CHECK_THAT(shop.tamp("compare --by method bed kept --store a").out, Contains("Welch t") && !Contains("paired t"));
  CHECK_THAT(shop.tamp("compare --by method bed denser --store a --format csv").out, Contains(",phi,3,3,"));
  CHECK(shop.tamp("compare --by method bed loose --store a").code == 2);
  CHECK(shop.tamp("compare --by commit 0000 1111 --store a").code == 2);
  CHECK(shop.tamp("compare a missing").code == 2);
}
