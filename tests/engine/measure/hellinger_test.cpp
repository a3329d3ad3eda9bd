// Hellinger distances by hand, and their sampling floors against sampling.
#include "engine/base/error.h"
#include "engine/measure/sampling_floor.h"
#include "tests/engine/measure/packings.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

using namespace tamp;
using namespace tamp::test;

namespace {

Packing with_radii(int dimension, std::vector<double> radii) {
  Packing packing = box_of(dimension, 100);
  packing.positions.assign(radii.size() * static_cast<std::size_t>(dimension), 50);
  packing.radii = std::move(radii);
  return packing;
}

std::vector<Measure> hellinger(const Packing& packing, const Scene& scene, std::int64_t bins = 80) {
  Metric metric = metric_of(MetricName::hellinger);
  metric.bins = bins;
  return measure(metric, packing, scene);
}

/// H of samples of n independent draws, the long way; in increasing order.
std::vector<double> distances(const SizeLaw& law, const SizeBins& bins, int power, std::size_t n,
                              std::uint64_t samples) {
  const auto q = bins.shares(power);
  std::vector<double> found;
  for (std::uint64_t k = 0; k < samples; ++k) {
    RandomStream draw("hellinger test", k);
    std::vector<double> p(bins.count(), 0);
    double total = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double r = law.quantile(draw.uniform());
      const double weight = std::pow(r, power);
      p[*bins.of(r)] += weight;
      total += weight;
    }
    for (double& share : p)
      share /= total;
    found.push_back(hellinger_distance(p, 0, q));
  }
  std::sort(found.begin(), found.end());
  return found;
}

double root_mean_square(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values)
    squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

Scene bimodal_scene(double ratio, double large_volume) {
  Scene scene;
  scene.psd.law = Law::bimodal;
  scene.psd.small_radius = 1;
  scene.psd.size_ratio = ratio;
  scene.psd.large_volume_fraction = large_volume;
  return scene;
}

Scene uniform_scene(int dimension, double low, double high) {
  Scene scene;
  scene.dimension = dimension;
  scene.psd.law = Law::histogram;
  scene.psd.edges = {low, high};
  scene.psd.weights = {1};
  return scene;
}

} // namespace

TEST_CASE("a discrete law has one bin per size") {
  // Number share of the large: (X/8) / (X/8 + 1 − X) with X = 8/9 is 1/2.
  const Scene scene = bimodal_scene(2, 8.0 / 9);
  const auto exact = hellinger(with_radii(3, {1, 2, 2, 1}), scene);
  CHECK(value_of(exact, "bins") == 2);
  CHECK(value_of(exact, "H_N") < 1e-15);
  CHECK(value_of(exact, "H_V") < 1e-15);
  const auto off = hellinger(with_radii(3, {1, 1, 1, 2}), scene);
  CHECK(value_of(off, "H_N") == Approx(std::sqrt(1 - std::sqrt(3.0 / 8) - std::sqrt(1.0 / 8))).epsilon(1e-12));
  CHECK(value_of(off, "H_V") ==
        Approx(std::sqrt(1 - std::sqrt(3.0 / 11 / 9) - std::sqrt(8.0 / 11 * 8 / 9))).epsilon(1e-12));
}

TEST_CASE("bins of a uniform law, by hand, and radii outside it as mass in no bin") {
  const Scene scene = uniform_scene(2, 1, 5);
  const auto one_each = hellinger(with_radii(2, {1.0, 2.5, 3.5, 5.0}), scene, 4); // both ends belong to the law
  CHECK(value_of(one_each, "H_N") < 1e-15);
  const auto half = hellinger(with_radii(2, {1.5, 1.2, 2.2, 2.9}), scene, 4);
  CHECK(value_of(half, "H_N") == Approx(std::sqrt(1 - std::sqrt(0.5))).epsilon(1e-12));
  const auto outside = hellinger(with_radii(2, {1.5, 2.5, 3.5, 6.0}), scene, 4);
  CHECK(value_of(outside, "H_N") == Approx(std::sqrt(1 - 0.75)).epsilon(1e-12));
  const auto apart = hellinger(with_radii(2, {0.5, 6.0}), scene, 4);
  CHECK(value_of(apart, "H_N") == 1);
  CHECK(value_of(apart, "H_S") == 1);
}

TEST_CASE("the well-conditioned distance is the paper's") {
  RandomStream draw("hellinger distance", 0);
  std::vector<double> p(20);
  std::vector<double> q(20);
  double sum_p = 0;
  double sum_q = 0;
  for (std::size_t k = 0; k < 20; ++k) {
    sum_p += p[k] = draw.uniform();
    sum_q += q[k] = draw.uniform();
  }
  const double outside = 0.3;
  double overlap = 0;
  for (std::size_t k = 0; k < 20; ++k) {
    p[k] *= (1 - outside) / sum_p;
    q[k] /= sum_q;
    overlap += std::sqrt(p[k] * q[k]);
  }
  CHECK(hellinger_distance(p, outside, q) == Approx(std::sqrt(1 - overlap)).epsilon(1e-12));
}

TEST_CASE("the number floor is exact: two bins and few draws by enumeration") {
  const std::vector<double> q{0.3, 0.7};
  for (const std::uint64_t n : {1U, 2U, 7U}) {
    double expected = 0; // E[1 − Σ sqrt(p q)] over all 2ⁿ outcomes
    for (std::uint64_t outcome = 0; outcome < (1U << n); ++outcome) {
      int first = 0;
      for (std::uint64_t k = 0; k < n; ++k)
        first += static_cast<int>((outcome >> k) & 1U);
      const double p = static_cast<double>(first) / static_cast<double>(n);
      const double chance = std::pow(q[0], first) * std::pow(q[1], static_cast<double>(n) - first);
      expected += chance * (1 - std::sqrt(p * q[0]) - std::sqrt((1 - p) * q[1]));
    }
    CHECK(number_floor(q, n) == Approx(std::sqrt(expected)).epsilon(1e-12));
  }
}

TEST_CASE("the number floor tends to sqrt((K - 1) / (8 n)) where every bin is full") {
  const std::vector<double> q(40, 1.0 / 40);
  CHECK(number_floor(q, 3000000) == Approx(std::sqrt(39.0 / 8 / 3e6)).epsilon(1e-4));
  CHECK(number_floor(q, 1000000) > number_floor(q, 3000000));
}

TEST_CASE("the floors of the paper's powder at N = 19 615 and K = 80") {
  const SizeLaw law(powder_scene(3).psd, 3);
  const SizeBins bins(law, 80);
  constexpr std::uint64_t kSamples = 100;
  for (const auto& [power, printed] : {std::pair{0, 0.019}, std::pair{3, 0.233}}) {
    const auto samples = distances(law, bins, power, 19615, kSamples);
    const double floor = power == 0 ? number_floor(bins.shares(0), 19615) : weighted_floor(law, bins, 3, 19615);
    CAPTURE(power, floor);
    CHECK(floor == Approx(root_mean_square(samples)).epsilon(0.05));
    CHECK(floor == Approx(power == 0 ? 0.0162 : 0.217).epsilon(0.02));
    // The paper's drop-and-roll row prints H_V 0.232; it is one sample of pure noise among others.
    CHECK(printed > samples.front());
    CHECK(printed < samples.back());
  }
}

TEST_CASE("floors agree with sampling the long way") {
  const std::vector<Scene> scenes{powder_scene(3), uniform_scene(3, 1, 3), bimodal_scene(5, 0.75)};
  for (const Scene& scene : scenes) {
    for (const int dimension : {2, 3}) {
      for (const std::size_t n : {1U, 30U, 1500U}) {
        CAPTURE(name_of(scene.psd.law), dimension, n);
        const SizeLaw law(scene.psd, dimension);
        const SizeBins bins(law, 50);
        const std::uint64_t samples = n == 1500 ? 150 : 2000;
        const double noise = n == 1500 ? 0.12 : 0.05; // of the rare large spheres, in both simulations
        const auto sampled = [&](int power) { return root_mean_square(distances(law, bins, power, n, samples)); };
        CHECK(number_floor(bins.shares(0), n) == Approx(sampled(0)).epsilon(noise));
        CHECK(weighted_floor(law, bins, dimension, n) == Approx(sampled(dimension)).epsilon(noise));
      }
    }
  }
}

TEST_CASE("the floor of three million spheres costs no more than that of thousands") {
  const SizeLaw law(powder_scene(3).psd, 3);
  const SizeBins bins(law, 80);
  const double floor = weighted_floor(law, bins, 3, 3000000);
  CHECK(floor > 0.01);
  CHECK(floor < 0.5 * weighted_floor(law, bins, 3, 19615));
}

TEST_CASE("a packing in another unit or dimension than the law is not compared") {
  Packing packing = with_radii(3, {1, 2});
  packing.unit = LengthUnit::m;
  CHECK_THROWS_AS(hellinger(packing, powder_scene(3)), Error);
  CHECK_THROWS_AS(hellinger(with_radii(3, {1, 2}), powder_scene(2)), Error);
}

TEST_CASE("the standard error of H foretells its scatter over samples of another law") {
  // Draws of a law that is wider than the one they are compared with, so that H lies well above its floor.
  Scene scene;
  scene.dimension = 3;
  scene.psd.law = Law::lognormal;
  scene.psd.mu_ln = 0;
  scene.psd.sigma_ln = 0.3;
  scene.psd.r_min = 0.3;
  scene.psd.r_max = 3;
  scene.size = {100, 100, 100};
  Psd wide = scene.psd;
  wide.sigma_ln = 0.5;
  const SizeLaw law(wide, 3);
  constexpr int kSamples = 60;
  constexpr double kOfSixty = 0.3; // a standard deviation from sixty samples is known to 9 %
  std::map<std::string, std::vector<double>> found;
  std::map<std::string, double> told;
  for (std::uint64_t k = 0; k < kSamples; ++k) {
    RandomStream draw("standard error of H", k);
    std::vector<double> radii(500);
    for (double& r : radii)
      r = law.quantile(draw.uniform());
    for (const Measure& measure : hellinger(with_radii(3, radii), scene, 8)) {
      found[measure.name].push_back(measure.value);
      told[measure.name] += measure.value / kSamples;
    }
  }
  for (const std::string name : {"H_N", "H_V"}) {
    double mean = 0;
    for (const double h : found[name])
      mean += h / kSamples;
    double variance = 0;
    for (const double h : found[name])
      variance += (h - mean) * (h - mean) / (kSamples - 1);
    CAPTURE(name, mean);
    CHECK(told[name + "_se"] == Approx(std::sqrt(variance)).epsilon(kOfSixty));
  }
}
