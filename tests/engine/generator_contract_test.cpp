// What every generator promises, checked over the table of generators, and what drop-and-roll promises over many seeds.
#include "engine/generate/generator.h"
#include "engine/measure/measure.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace tamp;
using namespace tamp::test;

namespace {

struct Case {
  std::string name;
  Job job;
};

Job job_of(MethodName method, std::int64_t dimension, const Psd& psd, double edge) {
  Job job;
  job.scene.dimension = dimension;
  job.scene.size = {edge};
  job.scene.psd = psd;
  job.scene = completed(job.scene);
  job.method.name = method;
  job.method.lattice.kind = dimension == 2 ? LatticeKind::hexagonal : LatticeKind::hcp;
  // Coarse, for speed: what is promised is checked against what is asked for.
  job.method.dem_gravity.overlap = 0.02;
  job.method.dem_gravity.force_balance = 0.01;
  REQUIRE(problems(job.scene).empty());
  return job;
}

/// Small scenes of every law that a method can have, named for messages.
std::vector<Case> cases_of(MethodName method) {
  const std::map<std::string, Psd> laws = {
      {"monodisperse", monodisperse_psd(1)},
      {"lognormal", lognormal_psd(0.30, 0.68, 0.1, 8)},
      {"bimodal", bimodal_psd(1, 4, 0.75)},
      {"normal", normal_psd(1.5, 0.4, 0.3, 3)},
      {"weibull", weibull_psd(1.5, 2.5, Weighting::number, 0.2, 4)},
      {"histogram", histogram_psd({0.5, 1, 1.5, 3}, {2, 5, 1}, Weighting::volume)},
  };
  std::vector<Case> cases;
  for (const std::int64_t dimension : {2, 3}) {
    for (const auto& [name, psd] : laws) {
      const bool exact_sizes = name == "monodisperse" || name == "bimodal";
      if ((method == MethodName::lattice && name != "monodisperse") ||
          (method == MethodName::drop_and_roll_me && exact_sizes))
        continue;
      cases.push_back(
          {name + " " + std::to_string(dimension) + "D", job_of(method, dimension, psd, dimension == 2 ? 40 : 17)});
    }
  }
  return cases;
}

/// Runs the case's generator, on a drop-and-roll packing of the same scene if it needs a packing to start from.
Generated made(const Case& c, const std::string& key) {
  if (info(c.job.method.name).start != Start::packing)
    return generate({c.job, key});
  Job parent = c.job;
  parent.method.name = MethodName::drop_and_roll;
  const Packing bed = generate({parent, key}).packing;
  return generate({c.job, key, &bed});
}

std::map<std::string, double> measured(MetricName name, const Packing& packing, const Scene& scene) {
  Metric metric;
  metric.name = name;
  std::map<std::string, double> values;
  for (const Measure& m : measure(metric, packing, scene))
    values[m.name] = m.value;
  return values;
}

bool same_bytes(const Packing& a, const Packing& b) {
  return a.positions == b.positions && a.radii == b.radii;
}

} // namespace

namespace {

/// Other programs take seconds to settle a bed.
bool is_slow(MethodName name) {
  return name == MethodName::lammps_gravity || name == MethodName::lammps_isostatic;
}

void check_promises(const Generator& generator, const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    INFO(name_of(generator.name) << ", " << c.name);
    const Generated out = made(c, "key one");
    if (out.outcome == Outcome::not_applicable && is_slow(generator.name)) {
      WARN("skipped: " << out.reason);
      return;
    }
    REQUIRE(out.outcome == Outcome::ok);
    CHECK(out.reason.empty());
    const Packing& p = out.packing;
    REQUIRE(p.count() > 20);
    CHECK(p.dimension == c.job.scene.dimension);
    CHECK(p.positions.size() == p.count() * static_cast<std::size_t>(p.dimension));
    REQUIRE_FALSE(out.measures.empty());
    CHECK(out.measures.front().name == "N");
    CHECK(out.measures.front().value == static_cast<double>(p.count()));
    // The box of a compression is as large as its spheres need it: about the scene's.
    const bool isostatic =
        generator.name == MethodName::dem_isostatic || generator.name == MethodName::lammps_isostatic;
    for (std::size_t a = 0; a < static_cast<std::size_t>(p.dimension); ++a) {
      if (isostatic && c.job.scene.count > 0) // then only its shape stays
        CHECK(p.size[a] == Approx(p.size[0]));
      else
        CHECK(p.size[a] == Approx(c.job.scene.size[a]).epsilon(isostatic ? 0.2 : 0));
    }

    const auto overlap = measured(MetricName::overlap, p, c.job.scene);
    const bool soft = generator.name == MethodName::dem_gravity || generator.name == MethodName::lammps_gravity;
    const double tolerance = soft        ? c.job.method.dem_gravity.overlap
                             : isostatic ? c.job.method.dem_isostatic.overlap_tolerance
                                         : 1e-10;
    CHECK(overlap.at("overlap_max") <= tolerance);
    if (!soft)
      CHECK(overlap.at("overlap_walls") == 0);

    CHECK(same_bytes(made(c, "key one").packing, p));
  }
}

} // namespace

TEST_CASE(
    "every generator: spheres inside the box, no more overlap than tolerated, N in the measures, same key same bytes") {
  for (const Generator& generator : generators()) {
    if (!is_slow(generator.name))
      check_promises(generator, cases_of(generator.name));
  }
}

TEST_CASE("generators that start other programs promise the same, on a powder of each dimension", "[slow]") {
  for (const Generator& generator : generators()) {
    if (!is_slow(generator.name))
      continue;
    std::vector<Case> cases = cases_of(generator.name);
    std::erase_if(cases, [](const Case& c) { return c.name != "bimodal 2D" && c.name != "normal 3D"; });
    REQUIRE(cases.size() == 2);
    for (Case& c : cases) {
      c.job.scene.count = 60;
      c.job.method.dem_isostatic.overlap_tolerance = 0.02;
    }
    check_promises(generator, cases);
  }
}

TEST_CASE("a change of the unit of length changes nothing else") {
  constexpr double scale = 0x1.0p-20; // a power of two near 1e-6, so that scaling rounds nothing
  for (const std::int64_t dimension : {2, 3}) {
    for (const Sides sides : {Sides::walls, Sides::periodic}) {
      Job job = job_of(MethodName::drop_and_roll, dimension, bimodal_psd(1, 4, 0.75), dimension == 2 ? 40 : 17);
      job.scene.sides = sides;
      Job scaled = job;
      scaled.scene.psd.small_radius *= scale;
      for (double& edge : scaled.scene.size)
        edge *= scale;
      const Packing big = generate({job, "unit"}).packing;
      Packing small = generate({scaled, "unit"}).packing;
      for (double& x : small.positions)
        x /= scale;
      for (double& r : small.radii)
        r /= scale;
      CHECK(same_bytes(big, small));
    }
  }
}

TEST_CASE("drop-and-roll keeps to a stated count, or says that the box was full") {
  Job job = job_of(MethodName::drop_and_roll, 3, monodisperse_psd(1), 17);
  job.scene.count = 100;
  CHECK(generate({job, "count"}).packing.count() == 100);
  job.scene.count = 100000;
  const Generated full = generate({job, "count"});
  CHECK(full.outcome == Outcome::did_not_converge);
  CHECK(full.reason.find("of 100000 spheres") != std::string::npos);
}

TEST_CASE("without a lid spheres may end above the box, with one they may not; keeping the radius ends sooner") {
  Job job = job_of(MethodName::drop_and_roll, 3, lognormal_psd(0.30, 0.68, 0.1, 8), 17);
  const Packing lidded = generate({job, "lid"}).packing;
  for (std::size_t i = 0; i < lidded.count(); ++i)
    CHECK(lidded.centre<3>(i)[2] + lidded.radii[i] <= 17);
  CHECK(lidded.boundary[2] == Boundary::wall);

  job.method.drop_and_roll.on_failure = OnFailure::keep;
  CHECK(generate({job, "lid"}).packing.count() < lidded.count());

  job.method.drop_and_roll.lid = false;
  job.scene.count = static_cast<std::int64_t>(2 * lidded.count());
  const Generated open = generate({job, "lid"});
  CHECK(open.outcome == Outcome::ok);
  CHECK(open.packing.boundary[2] == Boundary::open);
}

namespace {

/// The promise of drop-and-roll for one seed over all laws: no overlap above 1e-10, every sphere stable, none stuck.
void check_seed(int seed, Sides sides) {
  for (Case& c : cases_of(MethodName::drop_and_roll)) {
    INFO(c.name << ", seed " << seed << ", " << name_of(sides));
    c.job.scene.sides = sides;
    const Generated out = generate({c.job, "seed " + std::to_string(seed)});
    for (const Measure& m : out.measures) {
      if (m.name == "unresolved")
        CHECK(m.value == 0);
    }
    CHECK(measured(MetricName::overlap, out.packing, c.job.scene).at("overlap_max") <= 1e-10);
    CHECK(measured(MetricName::stable_alone, out.packing, c.job.scene).at("unstable_count") == 0);
  }
}

} // namespace

TEST_CASE("drop-and-roll: no overlap, no unstable or stuck sphere, a few seeds") {
  for (int seed = 0; seed < 4; ++seed)
    check_seed(seed, seed % 2 == 0 ? Sides::walls : Sides::periodic);
}
