// Several runs on one store: one waits for another, or joins it.
#include "store/store.h"
#include "tests/campaigns/cli/job_processes.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <csignal>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

namespace {

/// Runs `tamp ARGUMENTS` of another shop in the folder of the first, whose outputs must not mix with its own.
ChildProcess start_beside(const Workshop& other, const Workshop& shop, const std::string& arguments) {
  return other.start(arguments,
                     fmt::format("ln -sfn '{}' '{}/first'; ", shop.folder().string(), other.folder().string()));
}

/// The number behind "jobs run: ".
int jobs_run(const Said& said) {
  const std::string words = "jobs run: ";
  const auto at = said.out.find(words);
  return at == std::string::npos ? 0 : std::stoi(said.out.substr(at + words.size()));
}

} // namespace

TEST_CASE("a run that joins another shares its jobs: each is run once, and both end when all is done") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(150, 24, R"(, "metrics": ["phi", "overlap"])"));
  REQUIRE(shop.tamp("run discs.json --store whole").code == 0);

  ChildProcess first = shop.start("run discs.json --cores 1");
  REQUIRE(wait_until([&] { return !children_of(first.pid()).empty(); }));
  const Workshop other(TAMP_BINARY);
  ChildProcess joined = start_beside(other, shop, "run first/discs.json --join --cores 1 --store first/tamp-store");
  const bool leader_dies = GENERATE(false, true);
  if (leader_dies) {
    REQUIRE(wait_until([&] { return !children_of(joined.pid()).empty(); }));
    ::kill(first.pid(), SIGKILL); // the other takes over what it had claimed
  }
  const Said one = shop.end(first);
  const Said two = other.end(joined);
  CAPTURE(leader_dies, one.out, one.err, two.out, two.err);
  CHECK(one.code == (leader_dies ? -SIGKILL : 0));
  CHECK(two.code == 0);
  CHECK(jobs_run(two) > 0);
  if (!leader_dies)
    CHECK(jobs_run(one) + jobs_run(two) == 72);

  CHECK(without_times(shop.results("tamp-store")) == without_times(shop.results("whole")));
  CHECK(digests(shop.folder() / "tamp-store" / "packings") == digests(shop.folder() / "whole" / "packings"));
  const Store store = Store::open(shop.folder() / "tamp-store", Store::Mode::read);
  for (const auto& [key, outcome] : store.outcomes())
    CHECK(store.attempts(key).size() == 1);
  CHECK_THAT(shop.tamp("run discs.json").out, Contains("nothing to do"));
}

TEST_CASE("a run waits for another to end, or is told that it cannot join one that times jobs alone") {
  const Workshop shop(TAMP_BINARY);
  shop.write("long.json", disc_campaign(kLongEdge, 1, R"(, "timing": "exclusive", "metrics": ["phi"])"));
  shop.write("short.json", R"({"campaign": "short", )" +
                               disc_campaign(20, 1).substr(std::string(R"({"campaign": "discs", )").size()));
  ChildProcess first = shop.start("run long.json");
  REQUIRE(wait_until([&] { return !children_of(first.pid()).empty(); }));
  const std::string name = "process " + std::to_string(first.pid());
  const Workshop other(TAMP_BINARY);
  ChildProcess waiting = start_beside(other, shop, "run first/short.json --wait --store first/tamp-store");
  const Workshop third(TAMP_BINARY);
  ChildProcess joining = start_beside(third, shop, "run first/short.json --join --store first/tamp-store");
  const Said refused = third.end(joining);
  CAPTURE(refused.out, refused.err);
  CHECK(refused.code == 1);
  CHECK_THAT(refused.err, Contains(name) && Contains("times jobs alone"));
  ::kill(first.pid(), SIGINT);
  CHECK(shop.end(first).code == 130);
  const Said waited = other.end(waiting);
  CAPTURE(waited.out, waited.err);
  CHECK(waited.code == 0);
  CHECK_THAT(waited.err, Contains("waiting for " + name));
  CHECK(shop.tamp("run short.json --wait --join").code == 2);
}
