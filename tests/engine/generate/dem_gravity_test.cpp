// The generator dem-gravity: which effects run, independence of the unit, parents, what it refuses.
#include "engine/generate/generator.h"
#include "engine/generate/loose_cloud.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tamp;
using namespace tamp::test;

namespace {

Job small_job(std::int64_t dimension = 3) {
  Job job;
  job.scene.dimension = dimension;
  job.scene.size = {10};
  job.scene.count = 40;
  job.scene.sides = Sides::periodic;
  job.scene.psd = monodisperse_psd(1);
  job.scene = completed(job.scene);
  job.method.name = MethodName::dem_gravity;
  job.method.dem_gravity.overlap = 0.05;
  job.method.dem_gravity.force_balance = 0.02;
  job.method.dem_gravity.kinetic_energy = 1e-3;
  return job;
}

bool simulates(const Generated& out, std::string_view start) {
  return std::any_of(out.effects.simulated.begin(), out.effects.simulated.end(),
                     [&](const std::string& effect) { return effect.starts_with(start); });
}

double measure_of(const Generated& out, std::string_view name) {
  for (const Measure& m : out.measures) {
    if (m.name == name)
      return m.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace

TEST_CASE("only what the material calls for is simulated, and the record says so", "[dem-gravity]") {
  Job job = small_job();
  const Generated smooth = generate({job, "effects"});
  REQUIRE(smooth.outcome == Outcome::ok);
  CHECK_FALSE(simulates(smooth, "friction"));
  CHECK_FALSE(simulates(smooth, "inertia"));
  CHECK_FALSE(simulates(smooth, "adhesion"));
  CHECK(measure_of(smooth, "residual_overlap") <= 0.05);

  job.method.material.friction = 0.5;
  const Generated rough = generate({job, "effects"});
  REQUIRE(rough.outcome == Outcome::ok);
  CHECK(simulates(rough, "friction"));
  CHECK(simulates(rough, "inertia"));
  CHECK(measure_of(rough, "kinetic_energy") <= 1e-3);
}

TEST_CASE("Tabor's parameter chooses the law of adhesion, unless one is asked for", "[dem-gravity]") {
  Job job = small_job();
  job.scene.unit = LengthUnit::mm; // weak adhesion of grains this large: pull-off forces below their weight
  job.method.material.adhesion = 1e-3;
  const Generated soft = generate({job, "tabor"});
  REQUIRE(soft.outcome == Outcome::ok);
  CHECK(simulates(soft, measure_of(soft, "tabor") >= 0.32 ? "adhesion (JKR" : "adhesion (DMT"));
  job.method.material.adhesion_model = AdhesionModel::dmt;
  CHECK(simulates(generate({job, "tabor"}), "adhesion (DMT"));
  job.method.material.adhesion_model = AdhesionModel::jkr;
  CHECK(simulates(generate({job, "tabor"}), "adhesion (JKR"));
}

TEST_CASE("a frictionless bed has the same shape in every unit of length", "[dem-gravity]") {
  constexpr double scale = 0x1.0p-10;
  Job job = small_job();
  Job scaled = job;
  scaled.scene.psd.radius *= scale;
  for (double& edge : scaled.scene.size)
    edge *= scale;
  const Packing big = generate({job, "unit"}).packing;
  Packing small = generate({scaled, "unit"}).packing;
  for (double& x : small.positions)
    x /= scale;
  CHECK(big.positions == small.positions);
}

TEST_CASE("a settled bed that is settled again stays where it is, a loose packing comes down", "[dem-gravity]") {
  for (const std::int64_t dimension : {2, 3}) {
    Job job = small_job(dimension);
    const Generated first = generate({job, "parent"});
    REQUIRE(first.outcome == Outcome::ok);
    job.parent = "key of the first";
    const Generated again = generate({job, "child", &first.packing});
    REQUIRE(again.outcome == Outcome::ok);
    CHECK(again.packing.radii == first.packing.radii);
    CHECK(measure_of(again, "steps") <= measure_of(first, "steps") / 2);
    double lifted = 0;
    Packing loose = first.packing;
    for (std::size_t k = static_cast<std::size_t>(dimension) - 1; k < loose.positions.size();
         k += static_cast<std::size_t>(dimension)) {
      lifted = std::max(lifted, std::abs(again.packing.positions[k] - first.packing.positions[k]));
      loose.positions[k] *= 1.5;
    }
    CHECK(lifted < 0.2);
    const Generated down = generate({job, "child", &loose});
    REQUIRE(down.outcome == Outcome::ok);
    const auto mean_height = [&](const Packing& p) {
      double sum = 0;
      for (std::size_t i = 0; i < p.count(); ++i)
        sum += p.positions[(i + 1) * static_cast<std::size_t>(dimension) - 1];
      return sum / static_cast<double>(p.count());
    };
    CHECK(mean_height(down.packing) < 0.85 * mean_height(loose));
  }
}

TEST_CASE("hard particles do not overlap, and what that costs is told", "[dem-gravity]") {
  for (const double friction : {0.0, 0.5}) {
    Job job = small_job();
    job.scene.sides = Sides::walls;
    job.method.material.friction = friction;
    const Generated soft = generate({job, "hard"});
    job.method.hard = true;
    const Generated hard = generate({job, "hard"});
    REQUIRE(hard.outcome == Outcome::ok);
    const auto deepest = [](const Packing& p) {
      double ratio = 1;
      for (std::size_t i = 0; i < p.count(); ++i) {
        for (std::size_t a = 0; a < 3; ++a) {
          ratio = std::min(ratio, p.positions[3 * i + a] / p.radii[i]);
          if (a < 2)
            ratio = std::min(ratio, (p.size[a] - p.positions[3 * i + a]) / p.radii[i]);
        }
        for (std::size_t j = 0; j < i; ++j)
          ratio = std::min(ratio, (p.centre<3>(i) - p.centre<3>(j)).norm() / (p.radii[i] + p.radii[j]));
      }
      return ratio;
    };
    const double ratio = deepest(soft.packing);
    CHECK(ratio < 1);
    CHECK(deepest(hard.packing) >= 1);
    CHECK(hard.packing.radii == soft.packing.radii);
    CHECK(hard.packing.size[0] == Approx(soft.packing.size[0] / ratio).epsilon(1e-12));
    CHECK(measure_of(hard, "residual_overlap") == 0);
    CHECK(measure_of(soft, "hard_cost_phi_relative") == 0);
    CHECK(measure_of(hard, "hard_cost_phi_relative") == Approx(1 - ratio * ratio * ratio));
  }
}

TEST_CASE("a sphere wider than the box is refused with the reason", "[dem-gravity]") {
  Job job = small_job();
  job.scene.psd.radius = 5;
  const Generated out = generate({job, "wide"});
  CHECK(out.outcome == Outcome::not_applicable);
  CHECK(out.reason.find("does not fit") != std::string::npos);
}

TEST_CASE("spheres of a loose cloud touch neither each other nor a wall", "[cloud]") {
  RandomStream random("cloud radii", 1);
  std::vector<double> radii(300);
  for (double& r : radii)
    r = 0.2 + random.uniform() * random.uniform();
  const Vec<3> size(6, 7, 1);
  const std::array<bool, 3> periodic{true, false, false};
  const Cloud<3> cloud = loose_cloud<3>(size, periodic, radii, 0.3, RandomStream("cloud", 2));
  REQUIRE(cloud.centres.size() == radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    CHECK(cloud.centres[i][1] >= cloud.radii[i]);
    CHECK(cloud.centres[i][1] <= 7 - cloud.radii[i]);
    CHECK(cloud.centres[i][2] >= cloud.radii[i]);
    for (std::size_t j = 0; j < i; ++j) {
      Vec<3> apart = cloud.centres[i] - cloud.centres[j];
      apart[0] -= 6 * std::round(apart[0] / 6);
      CHECK(apart.norm() >= cloud.radii[i] + cloud.radii[j]);
    }
  }
  std::vector<double> sorted = cloud.radii;
  std::sort(sorted.begin(), sorted.end());
  std::sort(radii.begin(), radii.end());
  CHECK(sorted == radii);
}
