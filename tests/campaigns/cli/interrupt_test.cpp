// Runs that are cut off: kill -9, Ctrl-C, crashes of children, a store that is in use.
#include "engine/base/host.h"
#include "engine/base/random.h"
#include "tests/campaigns/cli/job_processes.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <csignal>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

TEST_CASE("a campaign killed twenty times at random moments ends like an uninterrupted one", "[slow]") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(60, 60));
  const double start = steady_seconds();
  REQUIRE(shop.tamp("run discs.json --store whole").code == 0);
  const double whole = steady_seconds() - start;

  RandomStream random("moments of kill -9", 1);
  int struck = 0;
  for (int kill = 0; kill < 20; ++kill) {
    ChildProcess child = shop.start("run discs.json --store cut");
    // The twenty together last two thirds of the whole, so that some of it is left on a machine of any speed.
    std::this_thread::sleep_for(std::chrono::duration<double>(whole / 15 * random.uniform()));
    ::kill(child.pid(), SIGKILL);
    struck += shop.end(child).code == -SIGKILL ? 1 : 0;
  }
  CHECK(struck >= 10);
  const Said last = shop.tamp("run discs.json --store cut");
  CAPTURE(last.out, last.err);
  CHECK(last.code == 0);
  CHECK_THAT(last.out, Contains("jobs run: ")); // the kills did not leave it complete
  CHECK_THAT(shop.tamp("run discs.json --store cut").out, Contains("nothing to do"));

  CHECK(digests(shop.folder() / "cut" / "packings") == digests(shop.folder() / "whole" / "packings"));
  CHECK(without_times(shop.results("cut")) == without_times(shop.results("whole")));
  CHECK(fs::is_empty(shop.folder() / "cut" / "incoming"));
}

TEST_CASE("Ctrl-C ends a run at once, leaves no child and no half result, and the run goes on later") {
  const Workshop shop(TAMP_BINARY);
  shop.write("long.json", disc_campaign(kLongEdge, 2));
  for (const int signal : {SIGINT, SIGTERM}) {
    ChildProcess child = shop.start("run long.json");
    REQUIRE(wait_until([&] { return !children_of(child.pid()).empty(); }));
    const std::vector<pid_t> jobs = children_of(child.pid());
    const double start = steady_seconds();
    ::kill(child.pid(), signal);
    const Said said = shop.end(child);
    CAPTURE(signal, said.out, said.err);
    CHECK(said.code == 130);
    CHECK(steady_seconds() - start < 5);
    CHECK_THAT(said.out, Contains("cancelled"));
    for (const pid_t job : jobs)
      CHECK_FALSE(alive(job));
  }
  CHECK(shop.results("tamp-store").empty());
  CHECK_FALSE(fs::exists(shop.folder() / "tamp-store" / "packings" / "00"));

  shop.write("short.json", disc_campaign(20, 1));
  CHECK(shop.tamp("run short.json").code == 0);
  CHECK(fs::is_empty(shop.folder() / "tamp-store" / "incoming"));
}

TEST_CASE("a killed run takes its children with it") {
  const Workshop shop(TAMP_BINARY);
  shop.write("long.json", disc_campaign(kLongEdge, 1));
  ChildProcess child = shop.start("run long.json");
  REQUIRE(wait_until([&] { return !children_of(child.pid()).empty(); }));
  const std::vector<pid_t> jobs = children_of(child.pid());
  ::kill(child.pid(), SIGKILL);
  shop.end(child);
  for (const pid_t job : jobs)
    CHECK(wait_until([&] { return !alive(job); }));
}

TEST_CASE("a second run on a store in use says who uses it and harms nothing") {
  const Workshop shop(TAMP_BINARY);
  shop.write("long.json", disc_campaign(kLongEdge, 1));
  shop.write("discs.json", disc_campaign(20, 1));
  ChildProcess first = shop.start("run long.json");
  REQUIRE(wait_until([&] { return !children_of(first.pid()).empty(); }));

  Workshop other(TAMP_BINARY); // the outputs of the two runs must not mix
  const std::string store = (shop.folder() / "tamp-store").string();
  const Said second = other.tamp(fmt::format("run '{}' --store '{}'", (shop.folder() / "discs.json").string(), store));
  CHECK(second.code == 1);
  CHECK_THAT(second.err, Contains("in use by process " + std::to_string(first.pid())));
  CHECK_THAT(other.tamp(fmt::format("status --store '{}'", store)).out,
             Contains("process " + std::to_string(first.pid()) + " on host"));
  CHECK_FALSE(children_of(first.pid()).empty());

  ::kill(first.pid(), SIGINT);
  CHECK(shop.end(first).code == 130);
  CHECK(shop.tamp("run discs.json").code == 0);
}

TEST_CASE("a child that crashes is an outcome of its job alone, and the next run tries it again") {
  const Workshop shop(TAMP_BINARY);
  shop.write("long.json", disc_campaign(600, 2, R"(, "metrics": ["overlap"])"));
  ChildProcess run = shop.start("run long.json --cores 1");
  REQUIRE(wait_until([&] { return !children_of(run.pid()).empty(); }));
  ::kill(children_of(run.pid()).front(), SIGSEGV);
  const Said said = shop.end(run);
  CAPTURE(said.out, said.err);
  CHECK(said.code == 1);
  CHECK_THAT(said.err, Contains("crashed: ended by signal SIGSEGV"));
  CHECK_THAT(said.out, Contains("2 ok, 1 crashed") && Contains("not possible, as their packing was not made: 1"));

  CHECK(shop.tamp("run long.json").code == 0);
  for (const auto& [key, row] : shop.results("tamp-store"))
    CHECK(row.at("outcome") == "ok");
}
