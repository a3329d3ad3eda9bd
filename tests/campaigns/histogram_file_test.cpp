// Measured sizes from CSV files: what the header means, how classes come about, and errors with their lines.
#include "campaigns/histogram_file.h"
#include "engine/base/error.h"
#include "engine/base/random.h"
#include "tests/campaigns/campaign_text.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <numeric>

namespace tamp::test {

namespace {

using Numbers = std::vector<double>;

MeasuredSizes sizes(const std::string& text) {
  return parse_measured_sizes(text, "p.csv");
}

std::string sizes_error(const std::string& text) {
  try {
    sizes(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("classes with counts, by range or by centre, as radius or diameter") {
  const auto ranges = sizes("# sieve\nradius (um),count\n0.5-1,10\n1 - 2,30\n\n4..8,2\n");
  CHECK(ranges.edges == Numbers{0.5, 1, 2, 4, 8});
  CHECK(ranges.weights == Numbers{10, 30, 0, 2}); // the gap holds nothing
  CHECK(ranges.unit == LengthUnit::um);
  CHECK(ranges.weighting == Weighting::number);

  const auto diameters = sizes("\xEF\xBB\xBF\"Diameter [µm]\";\"Volume %\"\r\n1-2;40\r\n2-4;60\r\n");
  CHECK(diameters.edges == Numbers{0.5, 1, 2});
  CHECK(diameters.weighting == Weighting::volume);
  CHECK(diameters.unit == LengthUnit::um);

  const auto centres = sizes("r\tweight\n1\t5\n2\t6\n4\t7\n");
  CHECK(centres.edges == Numbers{0.5, 1.5, 3, 5});
  CHECK(centres.weights == Numbers{5, 6, 7});
  CHECK_FALSE(centres.unit);
  CHECK_FALSE(centres.weighting);
}

TEST_CASE("single sizes become classes by Rice's rule that hold every size once") {
  RandomStream random("sizes", 0);
  std::string text = "diameter\n";
  double least = HUGE_VAL;
  double largest = 0;
  for (int i = 0; i < 1000; ++i) {
    const double d = 0.2 + std::round(random.uniform() * 500) / 10;
    least = std::min(least, d);
    largest = std::max(largest, d);
    text += std::to_string(d) + "\n";
  }
  const auto found = sizes(text);
  CHECK(found.weights.size() == 20); // 2·1000^(1/3)
  CHECK(found.edges.size() == 21);
  CHECK(found.edges.front() == Approx(least / 2).epsilon(1e-6));
  CHECK(found.edges.back() == Approx(largest / 2).epsilon(1e-6));
  CHECK(std::accumulate(found.weights.begin(), found.weights.end(), 0.0) == 1000);
  for (std::size_t i = 1; i + 1 < found.edges.size(); ++i)
    CHECK(found.edges[i] * found.edges[i] == Approx(found.edges[i - 1] * found.edges[i + 1]));
}

TEST_CASE("edges are converted to the scene's unit, or taken in it") {
  const auto found = sizes("radius_um,count\n1-2,1\n");
  CHECK(found.edges_in(LengthUnit::um) == Numbers{1, 2});
  CHECK(found.edges_in(LengthUnit::nm) == Numbers{1000, 2000});
  CHECK(found.edges_in(LengthUnit::m) == Numbers{1e-6, 2e-6});
  CHECK(sizes("radius,count\n1-2,1\n").edges_in(LengthUnit::mm) == Numbers{1, 2});
}

TEST_CASE("errors name file and line") {
  CHECK(sizes_error("").find("p.csv:1: the file is empty; allowed: a first line such as") == 0);
  CHECK(sizes_error("1.2\n3\n").find("p.csv:1: the header '1.2' does not say what the columns are") == 0);
  CHECK(sizes_error("size,count\n1-2,3\n").find("p.csv:1: the header 'size,count' does not say") == 0);
  CHECK(sizes_error("radius,colour\n")
            .find("p.csv:1: the header 'radius,colour' does not say what the second column counts") == 0);
  CHECK(sizes_error("radius\n") == "p.csv:1: the header is not followed by any size");
  CHECK(sizes_error("radius\n1\nabc\n") ==
        "p.csv:3: 'abc' is no number; allowed: numbers such as 12, 0.5 or 1e-3, decimals with a point");
  CHECK(sizes_error("radius\n1\n1,5\n") ==
        "p.csv:3: '1,5' has 2 columns where the header has 1 (decimals are written with a point)");
  CHECK(sizes_error("radius\n1\n-2\n") == "p.csv:3: the size -2 is not positive");
  CHECK(sizes_error("radius\n1\n2 um\n") == "p.csv:3: '2 um' is no size; allowed: a number");
  CHECK(sizes_error("radius,count\n1-2,3\n1.5-3,1\n").find("p.csv:3: the class begins below the end") == 0);
  CHECK(sizes_error("radius,count\n1-2,3\n3,1\n") == "p.csv:3: a class LOW-HIGH is due here, as in the lines before");
  CHECK(sizes_error("radius,count\n2-1,3\n") == "p.csv:2: '2-1' is no class; allowed: LOW-HIGH with LOW below HIGH");
  CHECK(sizes_error("radius,count\n1-2,-3\n") == "p.csv:2: the weight '-3' is not allowed; allowed: numbers from 0");
  CHECK(sizes_error("radius,count\n2,3\n1,1\n") == "p.csv:3: class centres must increase");
  CHECK(sizes_error("radius,count\n2,3\n").find("one class centre has no width") != std::string::npos);
  CHECK(sizes_error("radius,count\n1,3\n9,3\n").find("p.csv:2: the first class would reach below 0") == 0);
  CHECK(sizes_error("radius\n3\n3\n").find("at least two different sizes") != std::string::npos);
  CHECK(sizes_error("radius,count\n1-nan,3\n").find("p.csv:2: '1-nan' is no number") == 0);
}

TEST_CASE("a campaign takes its powder from a CSV file beside it") {
  const ScratchFolder folder;
  std::ofstream(folder / "powder.csv") << "diameter (um),volume\n1-2,40\n2-4,60\n";
  const std::string text = R"({"campaign": "measured", "methods": ["drop-and-roll"],
    "scene": {"unit": "nm", "size": 90000, "psd": {"law": "histogram", "file": "powder.csv"}}})";
  const Plan plan = read_campaign(text, folder / "c.json");
  REQUIRE(plan.jobs.size() == 1);
  const Psd& psd = plan.jobs[0].job.scene.psd;
  CHECK(psd.edges == Numbers{500, 1000, 2000});
  CHECK(psd.weights == Numbers{40, 60});
  CHECK(psd.weighting == Weighting::volume);

  const auto error = [&](std::string_view before, std::string_view after) {
    try {
      read_campaign(with(text, before, after), folder / "c.json");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  std::ofstream(folder / "bad.csv") << "radius,count\n1-2,x\n";
  CHECK(error("powder.csv", "bad.csv").find("bad.csv:2: 'x' is no number") != std::string::npos);
  CHECK(error("powder.csv", "bad.csv").find("c.json:2:80: at /scene/psd/file: ") != std::string::npos);
  CHECK(error("powder.csv", "none.csv").find("none.csv: No such file") != std::string::npos);
  CHECK(error("\"file\"", "\"edges\": [1, 2], \"file\"").find("\"edges\" and \"file\" both state") !=
        std::string::npos);
  CHECK(error("\"file\"", "\"weighting\": \"number\", \"file\"").find("contradicts the header of powder.csv") !=
        std::string::npos);
  CHECK(error("90000", "3000").find("smaller than the largest sphere (diameter 4000 nm)") != std::string::npos);
}

TEST_CASE("powders of several files can be swept") {
  const ScratchFolder folder;
  std::ofstream(folder / "a.csv") << "radius,count\n1-2,40\n";
  std::ofstream(folder / "b.csv") << "radius,count\n1-2,40\n2-3,1\n";
  const Plan plan = read_campaign(R"({"campaign": "measured", "methods": ["drop-and-roll"],
    "scene": {"size": 90, "psd": {"law": "histogram"}}, "sweep": {"grid": {"scene/psd/file": ["a.csv", "b.csv"]}}})",
                                  folder / "c.json");
  REQUIRE(plan.jobs.size() == 2);
  CHECK(plan.jobs[0].job.scene.psd.weights == Numbers{40});
  CHECK(plan.jobs[1].job.scene.psd.weights == Numbers{40, 1});
  CHECK(plan.jobs[1].point.at("scene/psd/file") == "b.csv");
}

} // namespace tamp::test
