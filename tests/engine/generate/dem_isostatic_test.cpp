// dem-isostatic: the size of the box, starts from a packing, hard particles, and when it does not apply.
#include "engine/generate/generator.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace tamp;
using namespace tamp::test;

namespace {

Job isostatic_job(const Psd& psd, double edge) {
  Job job;
  job.scene.size = {edge};
  job.scene.psd = psd;
  job.scene = completed(job.scene);
  job.method.name = MethodName::dem_isostatic;
  return job;
}

std::map<std::string, double> measures(const Generated& out) {
  std::map<std::string, double> values;
  for (const Measure& m : out.measures)
    values[m.name] = m.value;
  return values;
}

} // namespace

TEST_CASE("without a count the final box is the scene's: nearly when jammed, up to a sphere at a prescribed density") {
  Job job = isostatic_job(monodisperse_psd(1), 17);
  const Generated jammed = generate({job, "box"});
  REQUIRE(jammed.outcome == Outcome::ok);
  CHECK(jammed.packing.size[0] == Approx(17).epsilon(0.02));
  CHECK(jammed.packing.boundary[2] == Boundary::periodic);

  job.method.dem_isostatic.target_phi = 0.6;
  const Generated met = generate({job, "box"});
  REQUIRE(met.outcome == Outcome::ok);
  CHECK(measures(met).at("phi_box") == Approx(0.6).margin(1e-9));
  CHECK(met.packing.size[0] == Approx(17).epsilon(1e-3));

  job.scene.count = 300;
  CHECK(generate({job, "box"}).packing.count() == 300);
  job.method.dem_isostatic.target_phi = 0.75;
  const Generated beyond = generate({job, "box"});
  CHECK(beyond.outcome == Outcome::did_not_converge);
  CHECK(beyond.reason.find("jammed below") != std::string::npos);
}

TEST_CASE("hard particles do not overlap, and the record says what that cost") {
  Job job = isostatic_job(lognormal_psd(0.3, 0.4, 0.3, 4), 20);
  const auto soft = measures(generate({job, "hard"}));
  job.method.hard = true;
  const auto hard = measures(generate({job, "hard"}));
  CHECK(soft.at("residual_overlap") > 0);
  CHECK(soft.at("residual_overlap") <= 1e-4);
  CHECK(hard.at("residual_overlap") == 0);
  CHECK(hard.at("hard_cost_phi") > 0);
  CHECK(hard.at("hard_cost_phi") < 3e-4);
  CHECK(hard.at("phi_box") + hard.at("hard_cost_phi") == Approx(soft.at("phi_box")));
}

TEST_CASE("a packing to start from keeps its spheres and their order, and gets denser") {
  Job parent = isostatic_job(lognormal_psd(0.3, 0.5, 0.3, 4), 20);
  parent.method.name = MethodName::drop_and_roll;
  const Packing bed = generate({parent, "bed"}).packing;
  Job job = parent;
  job.method.name = MethodName::dem_isostatic;
  const Generated out = generate({job, "child", &bed});
  REQUIRE(out.outcome == Outcome::ok);
  CHECK(out.packing.radii == bed.radii);
  CHECK(out.packing.size[0] < bed.size[0]);
  // A sphere stays near its place: far less than half a box away, seen in shares of the box and through its faces.
  double moved = 0;
  for (std::size_t i = 0; i < bed.positions.size(); ++i) {
    const double share = out.packing.positions[i] / out.packing.size[0] - bed.positions[i] / bed.size[0];
    moved += std::abs(share - std::round(share)) / static_cast<double>(bed.positions.size());
  }
  CHECK(moved < 0.1);
}

TEST_CASE("a sphere that fills the box cannot be compressed") {
  const Generated out = generate({isostatic_job(monodisperse_psd(1), 2.1), "wide"});
  CHECK(out.outcome == Outcome::not_applicable);
  CHECK(out.reason.find("its own image") != std::string::npos);
}
