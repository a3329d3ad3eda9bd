// Scenes that no box or computer can hold are refused with the numbers that make them so.
#include "engine/model/scene.h"
#include "engine/model/size_law.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;

namespace {

Scene scene_of(std::vector<double> size, const Psd& psd) {
  Scene scene;
  scene.size = std::move(size);
  scene.psd = psd;
  return completed(scene);
}

} // namespace

TEST_CASE("the benchmark's scenes are possible, in every unit") {
  CHECK(problems(scene_of({133}, lognormal_psd())).empty());
  CHECK(problems(scene_of({2.1, 2.1, 40}, monodisperse_psd(1))).empty());
  CHECK(problems(scene_of({2e-4}, monodisperse_psd(1e-6))).empty());
}

TEST_CASE("one edge stands for all") {
  CHECK(scene_of({133}, lognormal_psd()).size == std::vector<double>{133, 133, 133});
}

TEST_CASE("impossible boxes are named with the edge and the reason") {
  const auto only = [](const Scene& scene) {
    const auto found = problems(scene);
    REQUIRE_FALSE(found.empty());
    CHECK(found.front().path == "size");
    return found.front().message;
  };
  CHECK_THAT(only(scene_of({1.9}, monodisperse_psd(1))), Catch::Contains("smaller than the largest sphere"));
  CHECK_THAT(only(scene_of({10, 10, 1.1e5}, monodisperse_psd(1))), Catch::Contains("times the smallest radius"));
  CHECK_THAT(only(scene_of({1e300}, monodisperse_psd(1))), Catch::Contains("times the smallest radius"));
  CHECK_THAT(only(scene_of({9e4}, monodisperse_psd(1))), Catch::Contains("makes room for about"));
  CHECK_THAT(only(scene_of({0}, monodisperse_psd(1))), Catch::Contains("above 0"));
  CHECK_THAT(only(scene_of({10, 10}, monodisperse_psd(1))), Catch::Contains("has 2 numbers"));
}

TEST_CASE("the guessed number of spheres is that of a bed of the guessed density") {
  const Scene scene = scene_of({10}, monodisperse_psd(1));
  CHECK(full_box_count(scene, SizeLaw(scene.psd, 3)) == Approx(kGuessedPhi * 1000 / (4 * 3.14159265358979 / 3)));
}
