// Whole packings of powders and boxes that are hard on rounding, checked against all pairs by brute force.
#include "engine/generate/generator.h"
#include "engine/measure/measure.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace tamp;
using namespace tamp::test;

namespace {

Job job_of(const Psd& psd, std::vector<double> size, std::int64_t count, Sides sides) {
  Job job;
  job.scene.dimension = static_cast<std::int64_t>(size.size());
  job.scene.size = std::move(size);
  job.scene.count = count;
  job.scene.sides = sides;
  job.scene.psd = psd;
  job.scene = completed(job.scene);
  REQUIRE(problems(job.scene).empty());
  return job;
}

/// Deepest overlap of any two spheres, or of a sphere and a wall, as a share of the smaller radius: all pairs that are
/// near each other along the longest axis, in order along it.
template <int D>
double deepest_overlap(const Packing& p) {
  const auto along = static_cast<std::size_t>(std::max_element(p.size.begin(), p.size.end()) - p.size.begin());
  const auto x = [&](std::size_t i) { return p.positions[i * D + along]; };
  std::vector<std::size_t> order(p.count());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return x(i) < x(j); });
  const double largest = *std::max_element(p.radii.begin(), p.radii.end());
  double deepest = 0;
  const auto look = [&](std::size_t i, std::size_t j) {
    Vec<D> d = p.centre<D>(j) - p.centre<D>(i);
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      if (p.boundary[n] == Boundary::periodic)
        d[a] -= std::round(d[a] / p.size[n]) * p.size[n];
    }
    deepest = std::max(deepest, (p.radii[i] + p.radii[j] - d.norm()) / std::min(p.radii[i], p.radii[j]));
  };
  for (std::size_t a = 0; a < order.size(); ++a) {
    const std::size_t i = order[a];
    const double reach = p.radii[i] + largest;
    for (std::size_t b = a + 1; b < order.size() && x(order[b]) - x(i) < reach; ++b)
      look(i, order[b]);
    for (std::size_t b = 0; p.boundary[along] == Boundary::periodic && b < a; ++b) {
      if (x(order[b]) + p.size[along] - x(i) >= reach)
        break;
      look(i, order[b]);
    }
    for (std::size_t axis = 0; axis < D; ++axis) {
      const double c = p.positions[i * D + axis];
      if (p.boundary[axis] == Boundary::wall)
        deepest = std::max({deepest, (p.radii[i] - c) / p.radii[i], (c + p.radii[i] - p.size[axis]) / p.radii[i]});
    }
  }
  return deepest;
}

double value_of(std::span<const Measure> measures, std::string_view name) {
  const auto* const found = std::find_if(measures.data(), measures.data() + measures.size(),
                                         [&](const Measure& m) { return m.name == name; });
  return found == measures.data() + measures.size() ? std::nan("") : found->value;
}

/// The share of spheres that may be given up as unresolved: where large spheres roll over ones a thousand times
/// smaller, rounding leaves a few without a way on. They are failures, never parts of the packing.
constexpr double kGivenUp = 1e-3;

Packing checked(const Job& job, std::string_view key, double given_up = 0) {
  const Generated out = generate({job, key});
  const Packing& p = out.packing;
  INFO(p.count() << " spheres");
  REQUIRE(p.count() > 0);
  CHECK(value_of(out.measures, "unresolved") <= given_up * static_cast<double>(p.count()));
  CHECK(std::all_of(p.positions.begin(), p.positions.end(), [](double c) { return std::isfinite(c); }));
  CHECK((p.dimension == 2 ? deepest_overlap<2>(p) : deepest_overlap<3>(p)) <= 1e-10);
  Metric stable;
  stable.name = MetricName::stable_alone;
  CHECK(value_of(measure(stable, p, job.scene), "unstable_count") == 0);
  return p;
}

std::int64_t large_spheres(const Packing& p, double larger_than) {
  return std::count_if(p.radii.begin(), p.radii.end(), [&](double r) { return r > larger_than; });
}

} // namespace

TEST_CASE("hard geometry: size ratio 100 with ten large spheres", "[slow]") {
  for (const Sides sides : {Sides::walls, Sides::periodic}) {
    INFO(name_of(sides));
    // Ten large spheres each, and as many small ones as the volume fraction gives: 40 000 and 33 000.
    CHECK(large_spheres(checked(job_of(bimodal_psd(1, 100, 0.996), {520, 520, 700}, 40170, sides), "rho"), 50) == 10);
    CHECK(large_spheres(checked(job_of(bimodal_psd(1, 100, 0.75), {800, 1000}, 33343, sides), "rho"), 50) == 10);
  }
}

TEST_CASE("hard geometry: a lognormal powder of sigma 1.5, radii over three orders of magnitude", "[slow]") {
  const Psd psd = lognormal_psd(0, 1.5, 0.06, 100); // 1e4 of its smallest radii to a box edge
  for (const Sides sides : {Sides::walls, Sides::periodic}) {
    INFO(name_of(sides));
    for (int seed = 0; seed < 3; ++seed) {
      checked(job_of(psd, {600, 600}, 10000, sides), "sigma " + std::to_string(seed), kGivenUp);
      checked(job_of(psd, {300, 300, 300}, 10000, sides), "sigma " + std::to_string(seed), kGivenUp);
    }
  }
}

TEST_CASE("hard geometry: equal spheres in the longest boxes that a scene may have") {
  for (const Sides sides : {Sides::walls, Sides::periodic}) {
    INFO(name_of(sides));
    for (const double share : {0.01, 0.1, 1.0}) {
      const double longest = share * kLongestBox;
      INFO("edge " << longest);
      checked(job_of(monodisperse_psd(1), {longest, 5}, 20000, sides), "long");
      checked(job_of(monodisperse_psd(1), {longest, 5, 8}, 20000, sides), "long");
      checked(job_of(monodisperse_psd(1), {2.3, longest}, 20000, sides), "tall");
      checked(job_of(monodisperse_psd(1), {2.2, 2.3, longest}, 10000, Sides::walls), "tall");
    }
  }
}
