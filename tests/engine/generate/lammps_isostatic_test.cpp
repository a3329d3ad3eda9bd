// The generator lammps-isostatic: what it asks LAMMPS for, what it refuses, and its density beside the native engine's.
#include "engine/generate/generator.h"
#include "engine/generate/lammps/isostatic_script.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace tamp;
using namespace tamp::test;

namespace {

/// Jammed boxes of two hundred spheres differ by some 0.01 in phi from one to the next.
constexpr double kSamePhi = 0.03;

Job box_of(const Psd& psd, std::int64_t count) {
  Job job;
  job.scene.size = {10};
  job.scene.count = count;
  job.scene.psd = psd;
  job.scene = completed(job.scene);
  job.method.name = MethodName::lammps_isostatic;
  job.method.dem_isostatic.overlap_tolerance = 0.01;
  return job;
}

double measure_of(const Generated& out, std::string_view name) {
  for (const Measure& m : out.measures) {
    if (m.name == name)
      return m.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace

TEST_CASE("a compression script is periodic and knows no gravity, friction or walls", "[lammps]") {
  SettleTask<2> task;
  task.modulus = 1;
  task.radii = {1, 2};
  const std::string script = isostatic_script(task, {.pressure = 1e-3, .step = 0.1, .most_looks = 9});
  CHECK(script.find("boundary p p p") != std::string::npos);
  CHECK(script.find("press/berendsen iso 0.001") != std::string::npos);
  CHECK(script.find("enforce2d") != std::string::npos);
  CHECK(script.find("thermo_modify norm no") > script.find("thermo_style"));
  for (const char* absent : {"gravity", "wall/gran", "mindlin"})
    CHECK(script.find(absent) == std::string::npos);
}

TEST_CASE("LAMMPS jams a box at the native engine's density", "[lammps][slow]") {
  Job job = box_of(monodisperse_psd(1), 200);
  const Generated theirs = generate({job, "box"});
  if (theirs.outcome == Outcome::not_applicable) {
    WARN("skipped: " << theirs.reason);
    return;
  }
  INFO(theirs.reason);
  REQUIRE(theirs.outcome == Outcome::ok);
  CHECK(measure_of(theirs, "residual_overlap") <= 0.01);
  job.method.name = MethodName::dem_isostatic;
  const Generated ours = generate({job, "box"});
  REQUIRE(ours.outcome == Outcome::ok);
  CHECK(measure_of(theirs, "phi_box") == Approx(measure_of(ours, "phi_box")).margin(kSamePhi));

  // Jammed spheres that are compressed again stay as dense as they are.
  job.method.name = MethodName::lammps_isostatic;
  job.parent = "key of the first";
  const Generated again = generate({job, "child", &theirs.packing});
  REQUIRE(again.outcome == Outcome::ok);
  CHECK(measure_of(again, "phi_box") == Approx(measure_of(theirs, "phi_box")).margin(kSamePhi));
}

TEST_CASE("a sphere that would meet its own image is refused", "[lammps]") {
  const Generated out = generate({box_of(bimodal_psd(1, 8, 0.99), 5), "narrow"});
  CHECK(out.outcome == Outcome::not_applicable);
  CHECK(out.reason.find("its own image") != std::string::npos);
}
