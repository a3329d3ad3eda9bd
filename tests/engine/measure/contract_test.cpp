// One contract over all metrics: finite values, no dependence on unit, order or threads, errors instead of nonsense.
#include "engine/base/error.h"
#include "tests/engine/measure/packings.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <cstring>
#include <limits>
#include <set>

using namespace tamp;
using namespace tamp::test;

namespace {

struct Example {
  std::string name;
  Packing packing;
};

std::vector<Example> examples() {
  std::vector<Example> all;
  for (const int dimension : {2, 3}) {
    for (const Boundary boundary : {Boundary::wall, Boundary::periodic, Boundary::open}) {
      RandomStream draw("contract", static_cast<std::uint64_t>(boundary));
      const std::string sides = fmt::format("{} {}D", name_of(boundary), dimension);
      all.push_back({fmt::format("random {}", sides), random_packing(dimension, 3000, 40, 5, boundary, draw)});
      all.push_back({fmt::format("cubic {}", sides), cubic_packing(dimension, 6, 1, boundary)});
    }
    // More spheres than a serial loop takes, so that threads have something to do.
    RandomStream draw("contract, many", 0);
    all.push_back({fmt::format("many {}D", dimension),
                   random_packing(dimension, 20000, dimension == 2 ? 400 : 90, 5, Boundary::periodic, draw)});
  }
  return all;
}

Scene rescaled_scene(Scene scene, double factor) {
  scene.psd.mu_ln += std::log(factor);
  for (double* length : {&scene.psd.r_min, &scene.psd.r_max, &scene.psd.small_radius})
    *length *= factor;
  return scene;
}

Packing in_reverse(const Packing& packing) {
  Packing reversed = packing;
  const auto d = static_cast<std::size_t>(packing.dimension);
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const std::size_t from = packing.count() - 1 - i;
    reversed.radii[i] = packing.radii[from];
    for (std::size_t a = 0; a < d; ++a)
      reversed.positions[i * d + a] = packing.positions[from * d + a];
  }
  return reversed;
}

/// Few bins, which keep the simulated sampling floor cheap, and few steps of what iterates.
Metric cheap(MetricName name) {
  Metric metric = metric_of(name);
  metric.bins = 8;
  metric.iterations = 40;
  return metric;
}

/// Numbers that count must agree exactly, others to the rounding of long sums, those of an iteration to where it ends.
void check_same(MetricName name, const std::vector<Measure>& a, const std::vector<Measure>& b) {
  const bool iterates = name == MetricName::stable_loaded;
  const double rounding = iterates ? 1e-3 : 1e-11;
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    CAPTURE(a[k].name);
    CHECK(a[k].name == b[k].name);
    // A Hellinger distance near 0 is the root of a rounded number.
    CHECK(b[k].value == Approx(a[k].value).epsilon(rounding).margin(iterates ? 1e-3 : 1e-12));
  }
}

} // namespace

TEST_CASE("every metric has a row, once") {
  std::set<MetricName> names;
  for (const Measurement& row : measurements())
    names.insert(row.name);
  CHECK(names.size() == measurements().size());
  for (const MetricInfo& row : metrics())
    CHECK(names.count(row.name) == 1);
}

TEST_CASE("all metrics on all packings") {
  for (const Example& example : examples()) {
    for (const MetricInfo& row : metrics()) {
      CAPTURE(example.name, name_of(row.name));
      const Metric metric = cheap(row.name);
      const Scene scene = scene_for(row.name, example.packing.dimension);
      const auto found = measure(metric, example.packing, scene);
      CHECK_FALSE(found.empty());
      for (const Measure& m : found) {
        CHECK(std::isfinite(m.value));
        CHECK(m.value >= 0);
        CHECK(m.unit == "1");
      }

      const Packing metres = rescaled(example.packing, 1e-6);
      check_same(row.name, found, measure(metric, metres, rescaled_scene(scene, 1e-6)));
      check_same(row.name, found, measure(metric, in_reverse(example.packing), scene));
    }
  }
}

TEST_CASE("metrics give the same bytes on one thread and on two") {
  for (const Example& example : examples()) {
    for (const MetricInfo& row : metrics()) {
      CAPTURE(example.name, name_of(row.name));
      const auto run = [&](std::size_t threads) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        return measure(cheap(row.name), example.packing, scene_for(row.name, example.packing.dimension));
      };
      const auto one = run(1);
      const auto two = run(2);
      REQUIRE(one.size() == two.size());
      for (std::size_t k = 0; k < one.size(); ++k)
        CHECK(std::memcmp(&one[k].value, &two[k].value, sizeof(double)) == 0);
    }
  }
}

TEST_CASE("packings that cannot be judged are errors that say why") {
  for (const MetricInfo& row : metrics()) {
    CAPTURE(name_of(row.name));
    const Metric metric = metric_of(row.name);
    const Scene scene = scene_for(row.name, 3);
    CHECK_THROWS_WITH(measure(metric, box_of(3, 10), scene), Catch::Contains("empty packing"));

    const Packing sound = cubic_packing(3, 2, 1, Boundary::wall);
    Packing broken = sound;
    broken.radii[3] = 0;
    CHECK_THROWS_AS(measure(metric, broken, scene), Error);
    broken.radii[3] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(measure(metric, broken, scene), Catch::Contains("sphere 3"));
    broken = sound;
    broken.positions[4] = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(measure(metric, broken, scene), Error);
    broken = sound;
    broken.positions.pop_back();
    CHECK_THROWS_AS(measure(metric, broken, scene), Error);
    broken = sound;
    broken.size[1] = 0;
    CHECK_THROWS_AS(measure(metric, broken, scene), Error);
    broken = sound;
    broken.dimension = 4;
    CHECK_THROWS_AS(measure(metric, broken, scene), Error);
  }
}

TEST_CASE("a single sphere is measured, or refused where it means nothing") {
  Packing one = box_of(3, 10);
  add(one, {5, 5, 1}, 1);
  for (const MetricInfo& row : metrics()) {
    CAPTURE(name_of(row.name));
    const bool density = row.name == MetricName::phi || row.name == MetricName::phi_paper;
    if (density) {
      CHECK_THROWS_AS(measure(metric_of(row.name), one, scene_for(row.name, 3)), Error);
      continue;
    }
    for (const Measure& m : measure(metric_of(row.name), one, scene_for(row.name, 3)))
      CHECK(std::isfinite(m.value));
  }
}
