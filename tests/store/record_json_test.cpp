// Records survive the way through JSON, and damaged texts are refused.
#include "engine/base/error.h"
#include "store/record_json.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/store/examples.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <limits>

using namespace tamp;
using Catch::Matchers::Contains;

TEST_CASE("a record reads back as it was written") {
  const Record written = example_record(3);
  const Record read = record_from_json(record_to_json(written), "text");
  CHECK(read.key == written.key);
  CHECK(read.kind == written.kind);
  CHECK(read.name == written.name);
  CHECK(read.revision == written.revision);
  CHECK(read.canonical == written.canonical);
  CHECK(read.outcome == written.outcome);
  CHECK(read.effects.simulated == written.effects.simulated);
  REQUIRE(read.effects.left_out.size() == 2);
  CHECK(read.effects.left_out[1].effect == "adhesion");
  CHECK(read.effects.left_out[1].why == "W = 0");
  REQUIRE(read.measures.size() == 3);
  CHECK(read.measures[1].unit == "um");
  CHECK(read.timing.mode == TimingMode::exclusive);
  CHECK(read.timing.wall_s == written.timing.wall_s);
  CHECK(read.timing.peak_rss_bytes == written.timing.peak_rss_bytes);
  CHECK(read.provenance.libraries == written.provenance.libraries);
  CHECK(read.provenance.dirty);
  CHECK(read.provenance.end_utc == written.provenance.end_utc);
  CHECK(text_of(read) == text_of(written));
}

TEST_CASE("every double reads back bit for bit") {
  Record record = example_record(0);
  record.measures.clear();
  RandomStream random("doubles", 0);
  for (int i = 0; i < 20'000; ++i) {
    const auto value = std::bit_cast<double>(random.bits());
    if (std::isfinite(value))
      record.measures.push_back({std::to_string(i), value, "1"});
  }
  record.measures.push_back({"minus zero", -0.0, "1"});
  record.measures.push_back({"largest", std::numeric_limits<double>::max(), "1"});
  const Record read = record_from_json(record_to_json(record), "text");
  REQUIRE(read.measures.size() == record.measures.size());
  for (std::size_t i = 0; i < read.measures.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(read.measures[i].value) != std::bit_cast<std::uint64_t>(record.measures[i].value))
      FAIL("the measure " << record.measures[i].name << " = " << record.measures[i].value << " changed");
  }
}

TEST_CASE("a number that is not finite is refused by name") {
  Record record = example_record(0);
  record.measures[1].value = std::nan("");
  CHECK_THROWS_WITH(record_to_json(record), Contains("gap") && Contains(record.key));
  record = example_record(0);
  record.timing.cpu_s = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(record_to_json(record), Contains("cpu_s"));
}

TEST_CASE("bytes that are not UTF-8 do not lose a record") {
  Record record = example_record(0);
  record.reason = "log: \xff\xfe end";
  CHECK(record_from_json(record_to_json(record), "text").reason == "log: \xEF\xBF\xBD\xEF\xBF\xBD end");
}

TEST_CASE("a text that is no record is refused with its name") {
  const std::string whole = record_to_json(example_record(0));
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, whole.size() / 2, whole.size() - 3}) {
    CHECK_THROWS_WITH(record_from_json(whole.substr(0, length), "file.json"), Contains("file.json"));
    CHECK_THROWS_AS(record_from_json(whole.substr(0, length), "file.json"), Error);
  }
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK_THROWS_WITH(record_from_json(with("\"tamp_record\": 1", "\"tamp_record\": 9"), "f"),
                    Contains("form") && Contains("9"));
  CHECK_THROWS_WITH(record_from_json(with("\"ok\"", "\"splendid\""), "f"), Contains("splendid"));
  CHECK_THROWS_WITH(record_from_json(with("\"canonical\"", "\"canonocal\""), "f"), Contains("canonical"));
  CHECK_THROWS_WITH(record_from_json("[]", "f"), Contains("f is not a whole record"));
}

TEST_CASE("a record file is written whole") {
  const ScratchFolder folder;
  write_record(folder / "r.json", example_record(1));
  CHECK(text_of(read_record(folder / "r.json")) == text_of(example_record(1)));
  CHECK(folder.size() == 1);
  CHECK_THROWS_WITH(read_record(folder / "none.json"), Contains("none.json"));
}
