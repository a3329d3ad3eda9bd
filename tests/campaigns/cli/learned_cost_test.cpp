// Learned time and memory: laws that are found again, intervals that hold, and what is said where nothing is known.
#include "campaigns/cli/learned_cost.h"
#include "engine/base/random.h"
#include "engine/model/scene.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;
using cli::CostPoint;
using cli::CostSum;
using cli::LearnedCost;

namespace {

constexpr double kRounding = 1e-9;

/// A standard normal number (Box and Muller).
double normal(RandomStream& random) {
  const double u = 1 - random.uniform();
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.141592653589793 * random.uniform());
}

} // namespace

TEST_CASE("an exact power law of time and an exact line of memory are found again") {
  std::vector<CostPoint> points;
  for (const double n : {100.0, 300.0, 1000.0, 5000.0})
    points.push_back({n, 2e-4 * std::pow(n, 1.25), 2e7 + 500 * n});
  points.push_back({0, 1, 1}); // not known
  const LearnedCost cost(points);
  CHECK(cost.points() == 4);
  CHECK_FALSE(cost.exponent_is_assumed());
  CHECK(cost.exponent() == Approx(1.25).epsilon(kRounding));
  CHECK(cost.seconds(1e6) == Approx(2e-4 * std::pow(1e6, 1.25)).epsilon(kRounding));
  CHECK(cost.bytes(1e6) == Approx(2e7 + 5e8).epsilon(kRounding));
  CHECK(cost.scatter() == Approx(0).margin(kRounding));
}

TEST_CASE("records of one size say nothing of the growth, which is then taken to be proportional") {
  const std::vector<CostPoint> points{{1000, 2, 0}, {1010, 2.02, 0}};
  const LearnedCost cost(points);
  CHECK(cost.exponent_is_assumed());
  CHECK(cost.seconds(5000) == Approx(10).epsilon(kRounding));
  CHECK(std::isnan(cost.bytes(1000)));
}

TEST_CASE("without records there is no guess, with too few no interval") {
  CHECK(LearnedCost({}).points() == 0);
  const std::vector<CostPoint> two{{100, 0.9, 0}, {1000, 9, 0}};
  CostSum sum;
  sum.add(LearnedCost(two), 1000, 0.5);
  CHECK(sum.seconds() == Approx(4.5).epsilon(kRounding));
  CHECK_FALSE(sum.half_width());
  CHECK_THAT(sum.text(), Contains("about 5 s (too few records"));
}

TEST_CASE("the interval of a sum of jobs holds what they took about as often as it says") {
  constexpr int kCampaigns = 400;
  constexpr double kScatter = 0.2;
  const auto seconds = [&](RandomStream& random, double n) { return 1e-3 * n * std::exp(kScatter * normal(random)); };
  int held = 0;
  for (std::uint64_t i = 0; i < kCampaigns; ++i) {
    RandomStream random("interval of costs", i);
    std::vector<CostPoint> points;
    for (int k = 0; k < 8; ++k) {
      const double n = 100 * std::exp(3 * random.uniform());
      points.push_back({n, seconds(random, n), 0});
    }
    const LearnedCost cost(points);
    CostSum sum;
    double took = 0;
    for (const double n : {500.0, 1000.0, 4000.0, 8000.0}) {
      sum.add(cost, n, 1);
      took += seconds(random, n);
    }
    CostSum all;
    all += sum;
    CHECK(all.half_width().value() == Approx(sum.half_width().value()).epsilon(kRounding));
    held += std::abs(std::log(took / sum.seconds())) <= sum.half_width().value() ? 1 : 0;
  }
  // 95 % with the sampling error of 400 trials (3 standard errors are 3.3 %) and the sum's linearised error.
  CHECK(held > 0.91 * kCampaigns);
  CHECK(held <= kCampaigns);
  CHECK(held < 0.995 * kCampaigns);
}

TEST_CASE("the expected number of spheres is the stated one, or what fills the box, in any unit of length") {
  Scene scene;
  scene.dimension = 2;
  scene.size = {100, 100};
  scene.psd.law = Law::monodisperse;
  scene.psd.radius = 1;
  const double full = cli::expected_spheres(scene);
  CHECK(full == Approx(1e4 * kGuessedPhi / 3.141592653589793));
  scene.size = {0.1, 0.1};
  scene.psd.radius = 1e-3;
  CHECK(cli::expected_spheres(scene) == Approx(full));
  scene.count = 7;
  CHECK(cli::expected_spheres(scene) == 7);
}

TEST_CASE("tamp plan learns from earlier records, and says where it cannot") {
  const Workshop shop(TAMP_BINARY);
  const std::string lattice = R"({"campaign": "b", "scene": {"dimension": 2, "size": 20, "psd": {"law": )"
                              R"("monodisperse", "radius": 1}}, "methods": ["drop-and-roll", "lattice"], "seed": 2, )"
                              R"("replicates": 3, "metrics": ["phi"]})";
  shop.write("discs.json", disc_campaign(20, 3, R"(, "metrics": ["phi"])"));
  CHECK_THAT(shop.tamp("plan discs.json").out, Contains("6 to run") && !Contains("about"));
  REQUIRE(shop.tamp("run discs.json").code == 0);
  CHECK_THAT(shop.tamp("plan discs.json").out, Contains("0 to run") && !Contains("about"));
  shop.write("more.json", lattice);
  const Said said = shop.tamp("plan more.json");
  CAPTURE(said.out);
  REQUIRE(said.code == 0);
  CHECK_THAT(said.out, Contains("  drop-and-roll: 3 to run; about ") && Contains("from 3 records of 76 spheres") &&
                           Contains("taken to grow as N") && Contains(" MB") && Contains("  lattice: ") &&
                           Contains("to run; nothing is known of such jobs here\n") && Contains("  phi: ") &&
                           Contains(", without the "));
}
