// The effects ledger: the rules with their numbers, the same before and after a run, and what asking for every effect
// does.
#include "engine/generate/effects_ledger.h"
#include "engine/generate/generator.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace tamp;

namespace {

Job bed_job(MethodName method) {
  Job job;
  job.scene.unit = LengthUnit::mm;
  job.scene.size = {8, 8, 12};
  job.scene.sides = Sides::periodic;
  job.scene.count = 60;
  job.scene.psd.law = Law::monodisperse;
  job.scene.psd.radius = 1;
  job.scene = completed(job.scene);
  job.method.name = method;
  job.method.dem_gravity.overlap = 0.02;
  job.method.dem_gravity.force_balance = 0.02;
  job.method.dem_gravity.kinetic_energy = 1e-3;
  job.method.dem_isostatic.overlap_tolerance = 0.01;
  return job;
}

/// The first entry that starts so, or nothing.
std::string simulated(const Effects& effects, std::string_view start) {
  const auto found = std::find_if(effects.simulated.begin(), effects.simulated.end(),
                                  [&](const std::string& one) { return one.starts_with(start); });
  return found == effects.simulated.end() ? std::string() : *found;
}

std::string why_left_out(const Effects& effects, std::string_view effect) {
  const auto found = std::find_if(effects.left_out.begin(), effects.left_out.end(),
                                  [&](const Effects::LeftOut& one) { return one.effect == effect; });
  return found == effects.left_out.end() ? std::string() : found->why;
}

bool mentions(const std::string& text, std::string_view words) {
  return text.find(words) != std::string::npos;
}

double mean_height(const Packing& packing) {
  double sum = 0;
  for (std::size_t i = 2; i < packing.positions.size(); i += 3)
    sum += packing.positions[i];
  return sum / static_cast<double>(packing.count());
}

} // namespace

TEST_CASE("each effect is simulated or left out, with the number that decides", "[ledger]") {
  Job job = bed_job(MethodName::dem_gravity);
  const Effects smooth = effects_ledger(job);
  CHECK(why_left_out(smooth, "friction") == "mu = 0");
  CHECK(why_left_out(smooth, "adhesion") == "W = 0");
  CHECK(mentions(why_left_out(smooth, "inertia"), "inertial number 0"));
  CHECK(simulated(smooth, "friction").empty());

  job.method.material.friction = 0.5;
  job.method.material.adhesion = 0.05;
  const Effects rough = effects_ledger(job);
  CHECK(mentions(simulated(rough, "friction"), "mu = 0.5"));
  // 3/2 π 0.05 J/m² 0.5 mm over 4/3 π (1 mm)³ 7800 kg/m³ 9.81 m/s²: 1.18e-4 N over 3.2e-4 N.
  CHECK(mentions(simulated(rough, "gravity"), "0.37 times"));
  CHECK(mentions(simulated(rough, "adhesion"), "Tabor's parameter"));
  // √2 times the diameter over the height of the box: 2 mm, 12 mm.
  CHECK(mentions(simulated(rough, "inertia"), "0.24"));
  CHECK(why_left_out(rough, "friction").empty());

  Job pressed = bed_job(MethodName::dem_isostatic);
  CHECK(mentions(why_left_out(effects_ledger(pressed), "gravity"), "isostatic"));
}

TEST_CASE("the ledger does not depend on the unit of length", "[ledger]") {
  for (const MethodName name : {MethodName::dem_gravity, MethodName::dem_isostatic, MethodName::lammps_gravity}) {
    Job job = bed_job(name);
    job.method.material.friction = 0.3;
    job.method.material.adhesion = 0.01;
    Job in_metres = job;
    in_metres.scene.unit = LengthUnit::m;
    in_metres.scene.psd.radius *= 1e-3;
    for (double& edge : in_metres.scene.size)
      edge *= 1e-3;
    CHECK(effects_ledger(job).simulated == effects_ledger(in_metres).simulated);
  }
}

TEST_CASE("what is told beforehand is what the record says", "[ledger]") {
  for (const MethodName name : {MethodName::drop_and_roll, MethodName::dem_gravity, MethodName::dem_isostatic}) {
    const Job job = bed_job(name);
    const Effects before = effects_ledger(job);
    const Effects after = generate({job, "ledger"}).effects;
    CHECK(after.simulated == before.simulated);
    REQUIRE(after.left_out.size() == before.left_out.size());
    for (std::size_t i = 0; i < before.left_out.size(); ++i) {
      CHECK(after.left_out[i].effect == before.left_out[i].effect);
      CHECK(after.left_out[i].why == before.left_out[i].why);
    }
  }
}

TEST_CASE("effects at zero change nothing but the time: the bed has the same height", "[ledger]") {
  Job job = bed_job(MethodName::dem_gravity);
  job.scene.size = {10, 10, 40};
  job.scene.count = 500;
  const Generated minimised = generate({job, "zeros"});
  job.method.material.simulate = Simulate::in_time;
  const Generated moved = generate({job, "zeros"});
  job.method.material.simulate = Simulate::all;
  const Generated all = generate({job, "zeros"});
  for (const Generated* one : {&minimised, &moved, &all})
    REQUIRE(one->outcome == Outcome::ok);
  CHECK_FALSE(simulated(moved.effects, "inertia").empty());
  CHECK(simulated(moved.effects, "friction").empty());
  CHECK(mentions(simulated(all.effects, "friction"), "asked for at 0"));
  CHECK(mentions(simulated(all.effects, "adhesion"), "asked for at 0"));
  // Beds that came down on other ways differ by the scatter of so few spheres.
  constexpr double kSameBed = 0.02;
  CHECK(mean_height(moved.packing) == Approx(mean_height(minimised.packing)).epsilon(kSameBed));
  CHECK(mean_height(all.packing) == Approx(mean_height(minimised.packing)).epsilon(kSameBed));
}

TEST_CASE("compression follows the motion where that is asked for, to the same density", "[ledger]") {
  Job job = bed_job(MethodName::dem_isostatic);
  job.scene.count = 200;
  const Generated minimised = generate({job, "zeros"});
  job.method.material.simulate = Simulate::all;
  const Generated all = generate({job, "zeros"});
  REQUIRE(minimised.outcome == Outcome::ok);
  INFO(all.reason);
  REQUIRE(all.outcome == Outcome::ok);
  const auto phi = [](const Generated& out) {
    double solid = 0;
    for (const double r : out.packing.radii)
      solid += 4.0 / 3.0 * 3.14159265358979 * r * r * r;
    return solid / (out.packing.size[0] * out.packing.size[1] * out.packing.size[2]);
  };
  CHECK(phi(all) == Approx(phi(minimised)).margin(0.03));
}
