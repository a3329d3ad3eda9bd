// What moving-enlarging promises: nothing shrinks, nothing overlaps, the bed is denser afterwards.
#include "engine/base/random.h"
#include "engine/generate/generator.h"
#include "engine/generate/moving_enlarging/near_list.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>

#include <string>

using namespace tamp;
using namespace tamp::test;

namespace {

Job bed_job(std::int64_t dimension, Sides sides, const Psd& psd) {
  Job job;
  job.scene.dimension = dimension;
  job.scene.size = {dimension == 2 ? 60.0 : 20.0};
  job.scene.sides = sides;
  job.scene.psd = psd;
  job.scene = completed(job.scene);
  return job;
}

double measure_of(const Generated& made, const std::string& name) {
  for (const Measure& measure : made.measures) {
    if (measure.name == name)
      return measure.value;
  }
  FAIL("no measure " << name);
  return 0;
}

/// Deepest overlap of any two spheres or of a sphere and a wall, relative to the smaller radius, by a look at all.
double deepest_overlap(const Packing& p) {
  const auto d = static_cast<std::size_t>(p.dimension);
  double deepest = 0;
  for (std::size_t i = 0; i < p.count(); ++i) {
    for (std::size_t a = 0; a < d; ++a) {
      const double x = p.positions[i * d + a];
      if (p.boundary[a] == Boundary::wall)
        deepest = std::max(deepest, (p.radii[i] - std::min(x, p.size[a] - x)) / p.radii[i]);
    }
    for (std::size_t j = i + 1; j < p.count(); ++j) {
      double squared = 0;
      for (std::size_t a = 0; a < d; ++a) {
        double x = std::abs(p.positions[i * d + a] - p.positions[j * d + a]);
        if (p.boundary[a] == Boundary::periodic)
          x = std::min(x, p.size[a] - x);
        squared += x * x;
      }
      const double overlap = p.radii[i] + p.radii[j] - std::sqrt(squared);
      deepest = std::max(deepest, overlap / std::min(p.radii[i], p.radii[j]));
    }
  }
  return deepest;
}

} // namespace

TEST_CASE("moving-enlarging: no overlap, no shrinking, nothing beyond the law, denser; many seeds") {
  for (const std::int64_t dimension : {2, 3}) {
    for (int seed = 0; seed < 12; ++seed) {
      Job job = bed_job(dimension, seed % 2 == 0 ? Sides::walls : Sides::periodic, lognormal_psd(0.3, 0.68, 0.1, 8));
      const std::string key = "bed " + std::to_string(seed);
      const Packing bed = generate({job, key}).packing;
      job.method.name = MethodName::drop_and_roll_me;
      const Generated made = generate({job, key, &bed});
      INFO(dimension << "D, seed " << seed);
      REQUIRE(made.outcome == Outcome::ok);
      REQUIRE(made.packing.count() == bed.count());
      CHECK(deepest_overlap(made.packing) <= 1e-10);
      CHECK(measure_of(made, "phi_box_gain") > 0);
      for (std::size_t i = 0; i < bed.count(); ++i) {
        CHECK(made.packing.radii[i] >= bed.radii[i]);
        CHECK(made.packing.radii[i] <= 8);
      }
    }
  }
}

TEST_CASE("moving-enlarging gives the same bytes on one and two threads, and in another unit of length") {
  constexpr double scale = 0x1.0p-20; // a power of two, so that scaling rounds nothing
  Job job = bed_job(3, Sides::periodic, lognormal_psd(0.3, 0.68, 0.1, 8));
  const Packing bed = generate({job, "bed"}).packing;
  job.method.name = MethodName::drop_and_roll_me;
  Packing one;
  {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    one = generate({job, "bed", &bed}).packing;
  }
  const Packing two = generate({job, "bed", &bed}).packing;
  CHECK(one.positions == two.positions);
  CHECK(one.radii == two.radii);

  Packing small = bed;
  for (auto* numbers : {&small.positions, &small.radii}) {
    for (double& x : *numbers)
      x *= scale;
  }
  for (double& edge : small.size)
    edge *= scale;
  job.scene = bed_job(3, Sides::periodic, lognormal_psd(0.3 + std::log(scale), 0.68, 0.1 * scale, 8 * scale)).scene;
  for (double& edge : job.scene.size)
    edge = 20 * scale;
  small = generate({job, "bed", &small}).packing;
  for (std::size_t i = 0; i < two.count(); ++i)
    CHECK(small.radii[i] / scale == Approx(two.radii[i]).epsilon(1e-9));
}

TEST_CASE("moving-enlarging refuses laws of exact sizes, and does not run without a packing") {
  for (const Psd& psd : {bimodal_psd(1, 4, 0.75), monodisperse_psd(1)}) {
    Job job = bed_job(2, Sides::walls, psd);
    const Packing bed = generate({job, "bed"}).packing;
    job.method.name = MethodName::drop_and_roll_me;
    const Generated made = generate({job, "bed", &bed});
    CHECK(made.outcome == Outcome::not_applicable);
    CHECK(made.reason.find("exact sizes") != std::string::npos);
    CHECK_THROWS_WITH(generate({job, "bed"}), "drop-and-roll-me needs a packing to start from");
  }
}

TEST_CASE("a near list knows whatever could touch within its budget") {
  RandomStream random("near list", 1);
  SearchBox<2> box;
  box.size = {3, 2};
  box.periodic = {true, false};
  box.wall[1] = {true, true};
  constexpr std::size_t count = 60;
  constexpr double budget = 0.5;
  std::vector<double> x(2 * count);
  std::vector<double> r(count);
  for (std::size_t i = 0; i < count; ++i) {
    x[2 * i] = 3 * random.uniform();
    x[2 * i + 1] = 2 * random.uniform();
    r[i] = 0.2 * std::pow(20.0, -random.uniform());
  }
  const NearList<2> near(box, x, r, budget);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> moved(x);
    std::vector<double> grown(r);
    for (std::size_t i = 0; i < count; ++i) { // each spends its budget in its own way
      const double share = random.uniform();
      const double angle = 2 * M_PI * random.uniform();
      moved[2 * i] += share * budget * r[i] * std::cos(angle);
      moved[2 * i + 1] += share * budget * r[i] * std::sin(angle);
      grown[i] += (1 - share) * budget * r[i];
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Vec<2> p(moved[2 * i], moved[2 * i + 1]);
      double room = std::min({p[1], 2 - p[1], 1.5});
      for (std::size_t j = 0; j < count; ++j) {
        for (const double turn : {-3.0, 0.0, 3.0}) {
          if (i != j)
            room = std::min(room, (p - Vec<2>(moved[2 * j] + turn, moved[2 * j + 1])).norm() - grown[j]);
        }
      }
      const double allowed = near.allowance(i, p);
      CHECK(allowed >= grown[i] * (1 - 1e-12));
      CHECK(std::min(near.room(i, p, moved, grown), allowed) == Approx(std::min(room, allowed)).margin(1e-12));
    }
  }
}
