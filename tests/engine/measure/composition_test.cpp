// The composition of bimodal packings against counts by hand, and at the ends of the law.
#include "engine/base/error.h"
#include "tests/engine/measure/packings.h"

using namespace tamp;
using namespace tamp::test;

namespace {

std::vector<Measure> composition(const Packing& packing, const Scene& scene) {
  return measure(metric_of(MetricName::composition), packing, scene);
}

Packing spheres(int dimension, std::size_t small, std::size_t large, double size_ratio) {
  Packing packing = box_of(dimension, 100);
  for (std::size_t i = 0; i < small + large; ++i)
    add(packing, std::vector<double>(static_cast<std::size_t>(dimension), 50), i < small ? 1 : size_ratio);
  return packing;
}

} // namespace

TEST_CASE("large spheres are counted and weighed by r^d") {
  for (const int dimension : {2, 3}) {
    const auto found = composition(spheres(dimension, 30, 10, 4), bimodal_scene(dimension));
    const double large = 10 * std::pow(4.0, dimension);
    CHECK(value_of(found, "N_L") == 10);
    CHECK(value_of(found, "X_L") == Approx(large / (large + 30)).epsilon(1e-14));
    CHECK(value_of(found, "P_NL") == 0.25);
  }
}

TEST_CASE("at size ratio 1 all spheres are large, whatever the fraction says") {
  Scene scene = bimodal_scene(3);
  scene.psd.size_ratio = 1;
  const auto found = composition(spheres(3, 7, 0, 1), scene);
  CHECK(value_of(found, "N_L") == 7);
  CHECK(value_of(found, "X_L") == 1);
  CHECK(value_of(found, "P_NL") == 1);
}

TEST_CASE("a packing of one class has none of the other") {
  CHECK(value_of(composition(spheres(3, 5, 0, 4), bimodal_scene(3)), "X_L") == 0);
  CHECK(value_of(composition(spheres(3, 0, 5, 4), bimodal_scene(3)), "X_L") == 1);
  CHECK(value_of(composition(spheres(3, 0, 5, 4), bimodal_scene(3)), "N_L") == 5);
}

TEST_CASE("the composition applies to bimodal laws alone") {
  const Packing packing = spheres(3, 5, 5, 4);
  CHECK_THROWS_AS(composition(packing, powder_scene(3)), NotApplicable);
  CHECK_THROWS_WITH(composition(packing, powder_scene(3)), Catch::Contains("lognormal"));
  for (const MetricInfo& row : metrics()) {
    CAPTURE(name_of(row.name));
    CHECK(row.applies(bimodal_scene(3).psd));
    CHECK(row.applies(powder_scene(3).psd) == (row.name != MetricName::composition));
  }
}

TEST_CASE("a composition in another unit or dimension is refused") {
  Scene metres = bimodal_scene(3);
  metres.unit = LengthUnit::m;
  CHECK_THROWS_AS(composition(spheres(3, 5, 5, 4), metres), Error);
  CHECK_THROWS_AS(composition(spheres(3, 5, 5, 4), bimodal_scene(2)), Error);
}
