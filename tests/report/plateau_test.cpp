// Where a quantity converges, and the cases in which nothing can be said.
#include "engine/base/error.h"
#include "report/plateau.h"

#include <catch2/catch.hpp>

using namespace tamp;

namespace {

Summary summary(double mean, double sd, std::size_t n = 5) {
  Summary s;
  s.n = n;
  s.mean = mean;
  s.sd = sd;
  return s;
}

constexpr PlateauCriterion kCriterion{0.01, 0.02};

} // namespace

TEST_CASE("The smallest box from which on all are near the largest") {
  const std::vector<SizePoint> points = {
      {30, summary(0.50, 0.01)}, {80, summary(0.60, 0.01)}, {110, summary(0.605, 0.01)}, {133, summary(0.608, 0.001)}};
  const Plateau found = find_plateau(points, kCriterion);
  CHECK(found.value == 0.608);
  CHECK(found.size == 80);
  CHECK(found.why_none.empty());
}

TEST_CASE("A box that comes near by chance before a larger one that does not is not on the plateau") {
  const std::vector<SizePoint> points = {
      {30, summary(0.60, 0.01)}, {80, summary(0.55, 0.01)}, {110, summary(0.60, 0.01)}, {133, summary(0.60, 0.01)}};
  CHECK(find_plateau(points, kCriterion).size == 110);
}

TEST_CASE("A wide spread ends the plateau though the mean is right") {
  const std::vector<SizePoint> points = {
      {30, summary(0.60, 0.03)}, {80, summary(0.60, 0.01)}, {110, summary(0.60, 0.01)}};
  CHECK(find_plateau(points, kCriterion).size == 80);
}

TEST_CASE("Where there is no plateau, the reason is given") {
  const auto why = [](const std::vector<SizePoint>& points) {
    const Plateau found = find_plateau(points, kCriterion);
    CHECK_FALSE(found.size);
    return found.why_none;
  };
  CHECK(why({{30, summary(0.5, 0.01)}}) == "only one size of box");
  CHECK_THAT(why({{30, summary(0.5, 0.01)}, {80, summary(0.6, 0.01)}}),
             Catch::Contains("0.1 from that of the largest"));
  CHECK_THAT(why({{30, summary(0.6, 0.01)}, {80, summary(0.6, 0.1)}}), Catch::Contains("standard deviation at 80"));
  CHECK_THAT(why({{30, summary(0.6, 0.01)}, {80, summary(0.6, 0, 1)}}), Catch::Contains("fewer than two replicates"));
  CHECK_THROWS_AS(find_plateau({}, kCriterion), InputError);
  CHECK_THROWS_AS(find_plateau(std::vector<SizePoint>{{80, summary(1, 0)}, {30, summary(1, 0)}}, kCriterion),
                  InputError);
}
