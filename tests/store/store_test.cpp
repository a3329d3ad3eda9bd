// Records, attempts, campaigns and readers of a store.
#include "engine/base/error.h"
#include "engine/base/host.h"
#include "store/store.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/store/examples.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fstream>
#include <thread>

using namespace tamp;
using Catch::Matchers::Contains;

TEST_CASE("a record comes back whole, from this store and from the next one on the folder") {
  const ScratchFolder folder;
  const Record record = example_record(0);
  {
    Store store = Store::open(folder / "s", Store::Mode::create);
    CHECK_FALSE(store.has(record.key));
    CHECK_FALSE(store.find(record.key));
    CHECK(store.put(record));
    CHECK(text_of(store.find(record.key).value()) == text_of(record));
  }
  for (const auto mode : {Store::Mode::read, Store::Mode::create}) {
    const Store store = Store::open(folder / "s", mode);
    CHECK(store.has(record.key));
    CHECK(text_of(store.find(record.key).value()) == text_of(record));
  }
}

TEST_CASE("an ok result stands; other outcomes are followed by further attempts") {
  const ScratchFolder folder;
  Store store = Store::open(folder / "s", Store::Mode::create);
  Record record = example_record(0);
  const std::string key = record.key;
  record.outcome = Outcome::failed;
  record.reason = "signal 11";
  record.provenance.start_utc = "1";
  CHECK(store.put(record));
  CHECK_FALSE(store.put(record)); // the same run once more
  record.provenance.start_utc = "2";
  record.outcome = Outcome::time_limited;
  CHECK(store.put(record));
  CHECK(store.outcome(key) == Outcome::time_limited);
  record.provenance.start_utc = "3";
  record.outcome = Outcome::ok;
  CHECK(store.put(record));
  record.provenance.start_utc = "4";
  record.outcome = Outcome::failed;
  CHECK_FALSE(store.put(record));
  record.outcome = Outcome::ok;
  CHECK_FALSE(store.put(record));

  CHECK(store.outcome(key) == Outcome::ok);
  CHECK(store.find(key)->provenance.start_utc == "3");
  const auto attempts = store.attempts(key);
  REQUIRE(attempts.size() == 3);
  CHECK(attempts[0].outcome == Outcome::failed);
  CHECK(attempts[0].reason == "signal 11");
  CHECK(attempts[1].outcome == Outcome::time_limited);
  CHECK(attempts[2].outcome == Outcome::ok);
}

TEST_CASE("finished keys are those that need no further run") {
  const ScratchFolder folder;
  Store store = Store::open(folder / "s", Store::Mode::create);
  const std::array again{Outcome::failed, Outcome::crashed, Outcome::cancelled, Outcome::lost};
  std::vector<std::string> expected;
  for (std::size_t i = 0; i < EnumNames<Outcome>::value.size(); ++i) {
    Record record = example_record(static_cast<std::int64_t>(i));
    record.outcome = static_cast<Outcome>(i);
    store.put(record);
    if (std::find(again.begin(), again.end(), record.outcome) == again.end())
      expected.push_back(record.key);
    CHECK(store.outcomes().at(record.key) == record.outcome);
  }
  const Record metric = example_metric_record({}, expected[0], {{"phi", 0.8, "1"}});
  store.put(metric);
  std::sort(expected.begin(), expected.end());
  CHECK(store.finished(JobKind::generation) == expected);
  CHECK(store.finished(JobKind::metric) == std::vector{metric.key});
  CHECK(store.finished().size() == expected.size() + 1);
}

TEST_CASE("records come in the order of the keys, and metrics by the packing they measure") {
  const ScratchFolder folder;
  Store store = Store::open(folder / "s", Store::Mode::create);
  for (const std::int64_t i : {0, 1, 2})
    store.put(example_record(i));
  const std::vector<std::string> keys{example_record(2).key, "unknown", example_record(0).key};
  const auto records = store.records(keys);
  REQUIRE(records.size() == 2);
  CHECK(records[0].key == keys[0]);
  CHECK(text_of(records[1]) == text_of(example_record(0)));

  Metric hellinger;
  hellinger.name = MetricName::hellinger;
  store.put(example_metric_record({}, keys[0], {{"phi", 0.8, "1"}}));
  store.put(example_metric_record(hellinger, keys[0], {{"H_N", 0.1, "1"}}));
  store.put(example_metric_record(hellinger, keys[2], {{"H_N", 0.2, "1"}}));
  const auto metrics = store.metric_records(keys[0]);
  REQUIRE(metrics.size() == 2);
  CHECK(metrics[0].name == "hellinger");
  CHECK(metrics[0].measures[0].value == 0.1);
  CHECK(metrics[1].name == "phi");
}

TEST_CASE("what cannot be remembered rightly is refused, and nothing of it stays") {
  const ScratchFolder folder;
  Store store = Store::open(folder / "s", Store::Mode::create);
  Record record = example_record(0);
  record.measures[2].value = std::nan("");
  CHECK_THROWS_WITH(store.put(record), Contains("tiny"));
  record = example_record(0);
  record.measures[2].name = "gap";
  CHECK_THROWS_WITH(store.put(record), Contains("gap"));
  record = example_record(0);
  record.packing_file = "packings/00/none.h5";
  CHECK_THROWS_WITH(store.put(record), Contains("none.h5"));
  CHECK_FALSE(store.has(record.key));

  store.put(example_record(0));
  Store reader = Store::open(folder / "s", Store::Mode::read);
  CHECK_THROWS_AS(reader.put(example_record(1)), Error);
  CHECK_FALSE(reader.has(example_record(1).key));
}

TEST_CASE("how far a campaign is, and what of it failed, is the latest attempt's word") {
  const ScratchFolder folder;
  Store store = Store::open(folder / "s", Store::Mode::create);
  store.put_campaign(example_plan("first", 5));
  store.put_campaign(example_plan("second", 2));
  CHECK(store.campaign_extent("first").planned == 5);
  CHECK(store.campaign_extent("first").recorded == 0);
  CHECK(store.unsuccessful("first").empty());
  for (const int i : {0, 1, 3}) {
    Record record = example_record(i);
    record.key = job_key(example_job(i));
    record.packing_file.clear();
    record.outcome = Outcome::crashed;
    store.put(record);
    if (i != 1)
      continue;
    record.outcome = Outcome::ok; // at the second attempt
    record.provenance.start_utc = "2025-01-02T00:00:00Z";
    record.provenance.end_utc = "2025-01-02T00:00:01Z";
    store.put(record);
  }
  Record metric = example_record(0);
  metric.kind = JobKind::metric;
  metric.name = "phi";
  metric.key = std::string(64, 'e');
  metric.parent = job_key(example_job(1));
  metric.packing_file.clear();
  metric.outcome = Outcome::failed;
  store.put(metric);
  CHECK(store.campaign_extent("first").recorded == 3);
  CHECK(store.campaign_extent("second").recorded == 2);
  CHECK(store.campaign_extent("none").planned == 0);
  const auto bad = store.unsuccessful("first");
  REQUIRE(bad.size() == 3);
  CHECK(bad[0].key == job_key(example_job(0)));
  CHECK(bad[0].outcome == Outcome::crashed);
  CHECK(bad[1].key == metric.key);
  CHECK(bad[1].kind == JobKind::metric);
  CHECK(bad[1].packing.key == metric.parent);
  CHECK(bad[2].packing.key == job_key(example_job(3)));
  CHECK(store.unsuccessful("second").size() == 2);
}

TEST_CASE("a campaign names its jobs, in place of what it named before") {
  const ScratchFolder folder;
  Store store = Store::open(folder / "s", Store::Mode::create);
  store.put_campaign(example_plan("first", 5));
  store.put_campaign(example_plan("second", 2));
  store.put_campaign(example_plan("first", 3));
  const auto campaigns = store.campaigns();
  REQUIRE(campaigns.size() == 2);
  CHECK(campaigns[0].name == "first");
  CHECK(campaigns[0].title == "An example");
  CHECK(campaigns[0].file == "campaigns/first.json");
  CHECK(campaigns[0].settings == R"({"metrics":[{"bins":80,"name":"hellinger"}],"report":{"tables":["lognormal_2d"]},)"
                                 R"("run":{"cpu_s":0,"memory_mb":4096,"samples":1,"timing":"shared","wall_s":3600}})");
  const auto jobs = store.campaign_jobs("first");
  REQUIRE(jobs.size() == 3);
  CHECK(jobs[2].campaign == "first");
  CHECK(jobs[2].key == job_key(example_job(2)));
  CHECK(jobs[2].label == "D&R");
  CHECK(jobs[2].replicate == 2);
  CHECK(jobs[2].point.at("scene/psd/mu_ln") == "0.5");
  CHECK(store.campaign_jobs("third").empty());

  store.put(example_record(1));
  store.put(example_record(9));
  CHECK(store.keys_without_campaign() == std::vector{example_record(9).key});
}

TEST_CASE("readers and several threads see whole records while one writes") {
  const ScratchFolder folder;
  Store writer = Store::open(folder / "s", Store::Mode::create);
  std::atomic<bool> is_done = false;
  std::atomic<int> broken = 0;
  std::atomic<int> looks = 0;
  std::vector<std::thread> readers;
  for (int r = 0; r < 2; ++r) {
    readers.emplace_back([&] {
      const Store reader = Store::open(folder / "s", Store::Mode::read);
      while (!is_done) {
        for (const auto& [key, outcome] : reader.outcomes())
          broken += reader.find(key)->measures.size() != 3;
        ++looks;
      }
    });
  }
  std::vector<std::thread> writers;
  for (std::int64_t w = 0; w < 2; ++w) {
    writers.emplace_back([&, w] {
      for (std::int64_t i = 0; i < 50; ++i)
        writer.put(example_record(2 * i + w));
    });
  }
  for (auto& thread : writers)
    thread.join();
  is_done = true;
  for (auto& thread : readers)
    thread.join();
  CHECK(broken == 0);
  CHECK(looks > 0);
  CHECK(writer.finished().size() == 100);
}

TEST_CASE("two stores on one folder take turns at writing") {
  const ScratchFolder folder;
  Store a = Store::open(folder / "s", Store::Mode::create);
  Store b = Store::open(folder / "s", Store::Mode::create);
  std::thread other([&] {
    for (std::int64_t i = 0; i < 50; ++i)
      b.put(example_record(i));
  });
  for (std::int64_t i = 0; i < 50; ++i)
    a.put(example_record(i));
  other.join();
  CHECK(a.finished().size() == 50);
  CHECK(a.attempts(example_record(7).key).size() == 1);
}

TEST_CASE("a missing or damaged store is an error that says so") {
  const ScratchFolder folder;
  CHECK_THROWS_WITH(Store::open(folder / "none", Store::Mode::read), Contains("there is no store") && Contains("none"));
  CHECK_FALSE(std::filesystem::exists(folder / "none"));

  {
    Store store = Store::open(folder / "s", Store::Mode::create);
    for (std::int64_t i = 0; i < 200; ++i)
      store.put(example_record(i));
  }
  const auto file = folder / "s" / "tamp.sqlite";
  {
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(4096);
    bytes << std::string(std::filesystem::file_size(file) - 4096, 'x');
  }
  CHECK_THROWS_WITH(Store::open(folder / "s", Store::Mode::read).outcomes(),
                    Contains("tamp.sqlite") && Contains("damaged"));
  std::ofstream(file, std::ios::binary) << std::string(8192, 'x');
  CHECK_THROWS_WITH(Store::open(folder / "s", Store::Mode::create), Contains("tamp.sqlite") && Contains("damaged"));
  CHECK_THROWS_WITH(Store::open(file / "below", Store::Mode::create), Contains("below"));
}

TEST_CASE("a hundred thousand keys are looked up at once", "[slow]") {
  const ScratchFolder folder;
  constexpr std::int64_t count = 100'000;
  { Store::open(folder / "s", Store::Mode::create); }
  fill_store(folder / "s", count);
  const Store store = Store::open(folder / "s", Store::Mode::read);
  const double start = steady_seconds();
  const auto finished = store.finished();
  const double listed = steady_seconds();
  std::size_t found = 0;
  for (const std::string& key : finished)
    found += store.has(key) ? 1U : 0U;
  const double looked_up = steady_seconds();
  CHECK(finished.size() == count);
  CHECK(found == count);
  INFO("finished() took " << listed - start << " s, has() of every key " << looked_up - listed << " s");
  CHECK(listed - start < 1);
  CHECK(looked_up - listed < 3);
}
