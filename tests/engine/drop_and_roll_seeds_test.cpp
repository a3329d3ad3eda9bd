// Drop-and-roll over many seeds of every law in small boxes, where walls, images and large spheres are everywhere.
#include "engine/base/random.h"
#include "engine/generate/generator.h"
#include "engine/measure/measure.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

using namespace tamp;
using namespace tamp::test;

namespace {

struct Powder {
  std::string name;
  Psd psd;
  double largest; ///< radius of its largest spheres
};

std::vector<Powder> powders() {
  return {
      {"monodisperse", monodisperse_psd(1), 1},
      {"bimodal, rho 4", bimodal_psd(1, 4, 0.75), 4},
      {"bimodal, rho 20", bimodal_psd(1, 20, 0.98), 20},
      {"lognormal, sigma 0.68", lognormal_psd(0.30, 0.68, 0.3, 8), 8},
      {"lognormal, sigma 1.5", lognormal_psd(0, 1.5, 0.05, 10), 10},
      {"normal", normal_psd(1.5, 0.4, 0.3, 3), 3},
      {"Weibull", weibull_psd(1.5, 2.5, Weighting::number, 0.2, 4), 4},
      {"histogram", histogram_psd({0.5, 1, 1.5, 3}, {2, 5, 1}, Weighting::volume), 3},
  };
}

double value_of(std::span<const Measure> measures, std::string_view name) {
  for (const Measure& m : measures) {
    if (m.name == name)
      return m.value;
  }
  return std::nan("");
}

double measured(MetricName name, std::string_view value, const Packing& packing, const Scene& scene) {
  Metric metric;
  metric.name = name;
  return value_of(measure(metric, packing, scene), value);
}

/// A box that holds 1 to about 3 of the largest spheres along each edge, sometimes just one, and at most `most`
/// spheres.
Job job_of(const Powder& powder, std::int64_t dimension, std::int64_t most, RandomStream& random) {
  Job job;
  job.scene.dimension = dimension;
  job.scene.psd = powder.psd;
  job.scene.sides = random.below(2) == 0 ? Sides::walls : Sides::periodic;
  for (int a = 0; a < dimension; ++a)
    job.scene.size.push_back(2 * powder.largest * (random.below(8) == 0 ? 1 : 1 + 2 * random.uniform()));
  job.scene.count = most;
  job.scene = completed(job.scene);
  return job;
}

void check(const Generated& out, const Scene& scene) {
  const Packing& p = out.packing;
  REQUIRE(p.count() > 0);
  CHECK(value_of(out.measures, "unresolved") == 0);
  // a sum is finite if and only if all its terms are
  double sum = 0;
  for (const double x : p.positions)
    sum += x;
  CHECK(std::isfinite(sum));
  CHECK(measured(MetricName::overlap, "overlap_max", p, scene) <= 1e-10);
  CHECK(measured(MetricName::stable_alone, "unstable_count", p, scene) == 0);
}

/// Seeds `first` to `first + seeds − 1` of every law, in 2D and 3D.
void check_seeds(int first, int seeds) {
  for (const Powder& powder : powders()) {
    for (const std::int64_t dimension : {2, 3}) {
      for (int seed = first; seed < first + seeds; ++seed) {
        INFO(powder.name << ", " << dimension << "D, seed " << seed);
        RandomStream random(powder.name + std::to_string(dimension), static_cast<std::uint64_t>(seed));
        const Job job = job_of(powder, dimension, 400, random);
        REQUIRE(problems(job.scene).empty());
        check(generate({job, "seed " + std::to_string(seed)}), job.scene);
      }
    }
  }
}

} // namespace

TEST_CASE("drop-and-roll: nothing overlaps, sticks or hangs in small boxes of every law, a few seeds") {
  check_seeds(0, 10);
}

TEST_CASE("drop-and-roll: nothing overlaps, sticks or hangs in small boxes of every law, 1000 seeds", "[slow]") {
  const char* wanted = std::getenv("TAMP_SEEDS"); // for a longer run
  check_seeds(1000, wanted != nullptr ? std::atoi(wanted) : 1000);
}
