// Timelines: lanes against brute force, axes without pauses, and a size that many jobs do not raise.
#include "engine/base/error.h"
#include "engine/base/random.h"
#include "report/figures/timeline.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <regex>

using namespace tamp;
using Catch::Contains;

namespace {

TimelineBar bar(double start, double end, const std::string& host = "a") {
  return {host, start, end, MethodName::drop_and_roll, true, "job"};
}

std::vector<TimelineBar> random_bars(std::uint64_t seed, std::size_t n) {
  RandomStream random("timeline", seed);
  std::vector<TimelineBar> bars;
  for (std::size_t i = 0; i < n; ++i) {
    const double start = 100 * random.uniform();
    bars.push_back(bar(start, start + 20 * random.uniform(), random.below(2) == 0 ? "a" : "b"));
  }
  return bars;
}

struct Rectangle {
  double x;
  double width;
};

/// The bars of a timeline: all rectangles but the background and, of ten pixels' width or so, those of the legend.
std::vector<Rectangle> rectangles(const std::string& svg) {
  static const std::regex form(R"re(<rect x="([\d.]+)" y="([\d.]+)" width="([\d.]+)")re");
  std::vector<Rectangle> found;
  for (std::sregex_iterator it(svg.begin(), svg.end(), form), end; it != end; ++it) {
    if (std::stod((*it)[2]) > 50)
      found.push_back({std::stod((*it)[1]), std::stod((*it)[3])});
  }
  return found;
}

} // namespace

TEST_CASE("no two bars of a lane overlap, and there are as many lanes as ever ran at once") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const std::vector<TimelineBar> bars = random_bars(seed, 1 + seed * 3);
    const std::vector<std::size_t> lanes = timeline_lanes(bars);
    for (const std::string host : {"a", "b"}) {
      std::size_t most = 0;
      std::size_t highest = 0;
      for (std::size_t i = 0; i < bars.size(); ++i) {
        if (bars[i].host != host)
          continue;
        highest = std::max(highest, lanes[i] + 1);
        std::size_t at_once = 0;
        for (std::size_t j = 0; j < bars.size(); ++j) {
          const bool same_host = bars[j].host == host;
          const bool runs = same_host && bars[j].start_s <= bars[i].start_s && bars[i].start_s < bars[j].end_s;
          at_once += runs ? 1U : 0U;
          if (j != i && same_host && lanes[j] == lanes[i])
            CHECK((bars[j].end_s <= bars[i].start_s || bars[i].end_s <= bars[j].start_s));
        }
        most = std::max(most, at_once);
      }
      CHECK(highest == most);
    }
  }
}

TEST_CASE("a timeline does not know when time began, nor in what it is counted") {
  std::vector<TimelineBar> bars = random_bars(7, 60);
  const std::vector<Rectangle> before = rectangles(timeline_svg(bars, "t"));
  for (TimelineBar& one : bars) {
    one.start_s = 5e8 + 60 * one.start_s;
    one.end_s = 5e8 + 60 * one.end_s;
  }
  const std::vector<Rectangle> after = rectangles(timeline_svg(bars, "t"));
  REQUIRE(before.size() == after.size());
  CHECK(before.size() > 20);
  constexpr double kPrinted = 0.011; // two digits of a pixel
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(before[i].x == Approx(after[i].x).margin(kPrinted));
    CHECK(before[i].width == Approx(after[i].width).margin(kPrinted));
  }
}

TEST_CASE("a pause is cut short, whatever its length, and a bar keeps its share of the time") {
  const auto drawn = [](double pause) {
    return rectangles(timeline_svg(std::vector{bar(0, 10), bar(10 + pause, 40 + pause)}, "t"));
  };
  CHECK(drawn(1e3).at(1).x == drawn(1e7).at(1).x);
  CHECK(drawn(1e3).at(1).width == Approx(3 * drawn(1e3).at(0).width).epsilon(1e-3));
  CHECK(drawn(1).at(1).x - drawn(1).at(0).width - drawn(1).at(0).x == Approx(900.0 / 41).epsilon(1e-2));
}

TEST_CASE("a hundred thousand jobs are a timeline of some hundred kilobytes that still counts them all") {
  std::vector<TimelineBar> bars;
  for (int i = 0; i < 100'000; ++i) {
    bars.push_back(bar(i, i + 0.9));
    if (i % 2 == 0)
      bars.back().method.reset();
  }
  const std::string svg = timeline_svg(bars, "t");
  CHECK(svg.size() < 300'000);
  CHECK_THAT(svg, Contains("a: 100000 jobs, at most 1 at once, lanes busy 90 % of the time shown"));
  static const std::regex tip(R"re(<title>(\d+) jobs, 0 of them not ok</title>)re");
  std::size_t jobs = 0;
  for (std::sregex_iterator it(svg.begin(), svg.end(), tip), end; it != end; ++it)
    jobs += std::stoul((*it)[1]);
  CHECK(jobs == bars.size());
}

TEST_CASE("a timeline tells what ran, in which colour, how it ended, and no text breaks it") {
  std::vector<TimelineBar> bars{bar(0, 1), bar(1, 2)};
  bars[0].ok = false;
  bars[0].what = "a <b> & \"c\"";
  bars[1].method.reset();
  const std::string svg = timeline_svg(bars, "D&R");
  CHECK_THAT(svg, Contains("<title>a &lt;b&gt; &amp; &quot;c&quot;</title>") && Contains("D&amp;R") &&
                      Contains("did not end ok") && Contains("metrics") && Contains("stroke=\"#0072B2\"") &&
                      Contains("1970-01-01 00:00:00 UTC"));
  CHECK(svg == timeline_svg(bars, "D&R"));
  CHECK_THAT(timeline_svg(std::vector{bar(3, 3)}, "an instant"), Contains("</svg>"));
  CHECK_THROWS_AS(timeline_svg({}, "t"), InputError);
}

TEST_CASE("times of records are read, and what has none is left out") {
  CHECK(seconds_of_utc("1970-01-02T01:02:03.25Z") == 86400 + 3723.25);
  CHECK(seconds_of_utc("2024-02-29T00:00:00Z").value() == 1709164800);
  CHECK_FALSE(seconds_of_utc("2023-02-29T00:00:00Z"));
  CHECK_FALSE(seconds_of_utc(""));
  Record record;
  record.name = "lattice";
  record.outcome = Outcome::time_limited;
  record.provenance.host = "h";
  CHECK_FALSE(timeline_bar(record, "x"));
  record.provenance.start_utc = "2024-02-29T00:00:00Z";
  record.provenance.end_utc = "2024-02-29T00:00:02.5Z";
  const TimelineBar made = timeline_bar(record, "x").value();
  CHECK(made.method == MethodName::lattice);
  CHECK(made.end_s - made.start_s == 2.5);
  CHECK_FALSE(made.ok);
  CHECK(made.what == "x: time-limited, 2.5 s");
  record.outcome = Outcome::lost;
  CHECK_FALSE(timeline_bar(record, "x"));
}
