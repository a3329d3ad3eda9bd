// Profiles of clusters: what is read, and what is said of mistakes.
#include "campaigns/cluster_profile.h"
#include "engine/base/error.h"

#include <catch2/catch.hpp>

using namespace tamp;
using Catch::Contains;

TEST_CASE("a profile sets what it states and leaves the rest") {
  const ClusterProfile profile =
      read_cluster_profile(R"({"partition": "long", "max_running": 20, "bundle_wall_s": 90.5} // mine)", "p.json");
  CHECK(profile.partition == "long");
  CHECK(profile.max_running == 20);
  CHECK(profile.bundle_wall_s == 90.5);
  CHECK(profile.account.empty());
  CHECK(profile.array_size == ClusterProfile{}.array_size);
}

TEST_CASE("every mistake of a profile is told with its place") {
  try {
    read_cluster_profile(R"({"partitoin": "long", "max_running": 2.5, "array_size": 0, "account": 7})", "p.json");
    FAIL("nothing was said");
  } catch (const InputError& e) {
    CHECK_THAT(e.what(), Contains("p.json:1:2") && Contains("nearest: partition") && Contains("/max_running") &&
                             Contains("a whole number from 0") && Contains("/array_size") && Contains("/account"));
  }
  CHECK_THROWS_AS(read_cluster_profile("[]", "p.json"), InputError);
  CHECK_THROWS_AS(read_cluster_profile("{", "p.json"), InputError);
  CHECK_THROWS_AS(load_cluster_profile("no such file"), InputError);
}
