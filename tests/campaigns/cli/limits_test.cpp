// What a job may use, what is tried again, and what is kept of a job that ended badly, by the real command.
#include "store/store.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

namespace {

Store opened(const Workshop& shop) {
  return Store::open(shop.folder() / "tamp-store", Store::Mode::read);
}

/// The only job of the store that is no metric.
std::string only_key(const Store& store) {
  const auto outcomes = store.outcomes(JobKind::generation);
  REQUIRE(outcomes.size() == 1);
  return outcomes.begin()->first;
}

std::string budget(const std::string& text) {
  return R"(, "budget": {)" + text + "}";
}

/// A program in the place of LAMMPS that says something in the name of the job that started it, and ends that.
void put_crasher(const Workshop& shop) {
  shop.write("crasher", "#!/bin/sh\necho the wall is down >>/proc/$PPID/fd/2\nkill -KILL $PPID\nsleep 5\n");
  fs::permissions(shop.folder() / "crasher", fs::perms::all);
}

} // namespace

TEST_CASE("a job that uses up its CPU time is time-limited") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(kLongEdge, 1, budget(R"("cpu_s": 1)")));
  const Said said = shop.tamp("run discs.json");
  CHECK(said.code == 1);
  CHECK_THAT(said.err, Contains("time-limited: not done after 1 s of CPU time"));
  const Store store = opened(shop);
  const Record record = store.find(only_key(store)).value();
  CHECK(record.limits.cpu_s == 1);
  CHECK(record.limits.wall_s == 3600);
  CHECK(record.limits.memory_mb == 4096);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // they do not live under a limit of address space
TEST_CASE("what ran out of memory is only tried again with more of it") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(kLongEdge, 1, budget(R"("memory_mb": 70)")));
  CHECK_THAT(shop.tamp("run discs.json").out, Contains("1 memory-limited"));
  CHECK_THAT(shop.tamp("run discs.json --retry-limited").out, Contains("nothing to do"));
  shop.write("discs.json", disc_campaign(kLongEdge, 1, budget(R"("memory_mb": 1000, "wall_s": 0.3)")));
  CHECK_THAT(shop.tamp("run discs.json").out, Contains("nothing to do"));
  CHECK_THAT(shop.tamp("run discs.json --retry-limited").out, Contains("1 time-limited"));
  // A machine may have been busy, so time is another matter.
  CHECK_THAT(shop.tamp("run discs.json --retry-limited").out, Contains("jobs run: 1 (1 time-limited)"));
  const Store store = opened(shop);
  CHECK(store.attempts(only_key(store)).size() == 3);
}
#endif

TEST_CASE("what a job said is kept, and what starts from its packing is skipped with the reason") {
  const Workshop shop(TAMP_BINARY);
  put_crasher(shop);
  shop.write("chain.json", R"({"campaign": "chain", "scene": {"size": 8, "psd": {"law": "monodisperse", "radius": 1}},
    "methods": [{"name": "lammps-gravity", "label": "bed"},
                {"name": "drop-and-roll-me", "label": "denser", "from": "bed"}]})");
  ::setenv("TAMP_LAMMPS", (shop.folder() / "crasher").c_str(), 1);
  const Said said = shop.tamp("run chain.json");
  ::unsetenv("TAMP_LAMMPS");
  CHECK(said.code == 1);
  CHECK_THAT(said.err,
             Contains("bed, replicate 0: crashed: ended by signal SIGKILL; its last words:\nthe wall is down"));
  CHECK_THAT(said.err, Contains("denser, replicate 0: skipped, as the packing it starts from was not made (bed, "));
  Store store = Store::open(shop.folder() / "tamp-store", Store::Mode::create);
  const std::string key = only_key(store);
  CHECK(read_file(store.log_path(key)).find("the wall is down") != std::string::npos);
  store.keep_log(key, shop.folder() / "none"); // the next run said nothing
  CHECK_FALSE(fs::exists(store.log_path(key)));
}

TEST_CASE("a job timed alone runs as often as samples are wanted, and each is kept") {
  const Workshop shop(TAMP_BINARY);
  shop.write("discs.json", disc_campaign(60, 1, R"(, "timing": "exclusive", "budget": {"samples": 5})"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  shop.write("discs.json", disc_campaign(60, 1));
  REQUIRE(shop.tamp("run discs.json --store once").code == 0);
  CHECK(digests(shop.folder() / "once" / "packings") == digests(shop.folder() / "tamp-store" / "packings"));
  const Store store = opened(shop);
  const Timing timing = store.find(only_key(store)).value().timing;
  REQUIRE(timing.samples.size() == 5);
  double all = 0;
  for (const TimeSample& sample : timing.samples) {
    CHECK(sample.wall_s > 0);
    all += sample.wall_s;
  }
  CHECK(timing.wall_s < all / 2);
}
