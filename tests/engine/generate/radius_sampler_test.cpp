// Draws against their law: goodness of fit, exact counts, the sampling floor of the Hellinger distance.
#include "engine/base/error.h"
#include "engine/generate/radius_sampler.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace tamp;
using namespace tamp::test;

namespace {

/// Largest distance between the empirical and the stated distribution function.
double kolmogorov_distance(const SizeLaw& law, std::vector<double> radii) {
  std::sort(radii.begin(), radii.end());
  const auto n = static_cast<double>(radii.size());
  double distance = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const double expected = law.cdf(radii[i]);
    const auto rank = static_cast<double>(i);
    distance = std::max({distance, expected - rank / n, (rank + 1) / n - expected});
  }
  return distance;
}

/// Hellinger distance of the r^k-weighted radii to the law over equal bins between its smallest and largest radius.
double hellinger(const SizeLaw& law, const std::vector<double>& radii, int k, std::size_t bins) {
  const double width = (law.largest() - law.smallest()) / static_cast<double>(bins);
  std::vector<double> p(bins, 0);
  double total = 0;
  for (const double r : radii) {
    const double weight = std::pow(r, k);
    p[std::min(static_cast<std::size_t>((r - law.smallest()) / width), bins - 1)] += weight;
    total += weight;
  }
  double overlap = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    const double left = law.smallest() + static_cast<double>(i) * width;
    const double q = law.weighted_cdf(left + width, k) - law.weighted_cdf(left, k);
    overlap += std::sqrt(p[i] / total * std::max(q, 0.0));
  }
  return std::sqrt(std::max(0.0, 1 - overlap));
}

struct Floor {
  double mean;
  double sd;
};

/// The Hellinger distance of perfect draws from the powder over K = 80 bins, for the benchmark's number of spheres.
Floor sampling_floor(const SizeLaw& law, Sampler kind, int k) {
  constexpr std::size_t kSpheres = 19'615;
  constexpr std::size_t kBins = 80;
  constexpr std::uint64_t kSeeds = 60;
  double sum = 0;
  double squares = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const double h = hellinger(law, draw_radii(law, kind, kSpheres, RandomStream("floor", seed)), k, kBins);
    sum += h;
    squares += h * h;
  }
  const double mean = sum / kSeeds;
  return {mean, std::sqrt(squares / kSeeds - mean * mean)};
}

bool same_bytes(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

} // namespace

TEST_CASE("random draws follow every law") {
  constexpr std::size_t kDraws = 10'000;
  // Passed by 99.999 % of true samples; sixteen laws, fixed streams.
  const double critical = 2.47 / std::sqrt(double{kDraws});
  for (const auto& [name, psd] : continuous_examples()) {
    CAPTURE(name);
    const SizeLaw law(psd, 3);
    const auto radii = draw_radii(law, Sampler::random, kDraws, RandomStream(name, 0));
    const double distance = kolmogorov_distance(law, radii);
    CHECK(distance < critical);
    CHECK(distance > 0.1 / std::sqrt(double{kDraws})); // independent draws do scatter
  }
}

TEST_CASE("the test of fit can tell a wrong law") {
  const auto radii = draw_radii(SizeLaw(lognormal_psd(0.30, 0.68), 3), Sampler::random, 10'000, RandomStream("ks", 0));
  CHECK(kolmogorov_distance(SizeLaw(lognormal_psd(0.30, 0.75), 3), radii) > 2.47 / 100);
}

TEST_CASE("every stratum of a block holds exactly one draw") {
  constexpr std::uint64_t kBlock = 500;
  for (const auto& [name, psd] : continuous_examples()) {
    CAPTURE(name);
    const SizeLaw law(psd, 3);
    RadiusSampler sampler(law, Sampler::stratified, kBlock, RandomStream("strata", 1));
    for (int block = 0; block < 3; ++block) {
      std::vector<double> radii(kBlock);
      for (double& r : radii)
        r = sampler.next();
      CHECK_FALSE(std::is_sorted(radii.begin(), radii.end()));
      std::sort(radii.begin(), radii.end());
      for (std::uint64_t i = 0; i < kBlock; ++i) {
        CHECK(radii[i] >= law.quantile(static_cast<double>(i) / kBlock));
        CHECK(radii[i] <= law.quantile(static_cast<double>(i + 1) / kBlock));
      }
    }
    CHECK(sampler.drawn() == 3 * kBlock);
  }
}

TEST_CASE("discrete laws get exact class counts from both samplers") {
  for (const Sampler kind : {Sampler::random, Sampler::stratified}) {
    for (const double rho : {1.5, 5.0, 20.0}) {
      for (const std::uint64_t block : {std::uint64_t{1}, std::uint64_t{7}, std::uint64_t{1000}}) {
        const SizeLaw law(bimodal_psd(1, rho, 0.75), 3);
        CAPTURE(rho, block);
        RadiusSampler sampler(law, kind, block, RandomStream("bimodal", block));
        std::uint64_t large = 0;
        for (std::uint64_t b = 0; b < 40; ++b) {
          for (std::uint64_t i = 0; i < block; ++i)
            large += sampler.next() > 1 ? 1U : 0U;
          const double expected = law.class_shares()[1] * static_cast<double>(sampler.drawn());
          CHECK(std::abs(static_cast<double>(large) - expected) <= 0.5 + 1e-9);
        }
      }
    }
  }
}

TEST_CASE("class counts of a known number of spheres are rounded, their order is random") {
  const SizeLaw law(bimodal_psd(1, 5, 0.75), 3);
  const auto expected = static_cast<std::ptrdiff_t>(std::llround(law.class_shares()[1] * 30'000));
  const auto radii = draw_radii(law, Sampler::random, 30'000, RandomStream("order", 0));
  CHECK(std::count(radii.begin(), radii.end(), 5.0) == expected);
  const auto half = radii.begin() + 15'000;
  // Hypergeometric: six standard deviations of the count in the first half.
  const auto in_half = static_cast<double>(std::count(radii.begin(), half, 5.0));
  CHECK(std::abs(in_half - static_cast<double>(expected) / 2) < 6 * std::sqrt(static_cast<double>(expected) / 4));
  CHECK_FALSE(same_bytes(radii, draw_radii(law, Sampler::random, 30'000, RandomStream("order", 1))));
}

TEST_CASE("a shuffled block has no memory of its order") {
  constexpr std::size_t kBlock = 20'000;
  const SizeLaw law(lognormal_psd(), 3);
  const auto radii = draw_radii(law, Sampler::stratified, kBlock, RandomStream("shuffle", 3));
  double with_place = 0;
  double with_next = 0;
  for (std::size_t i = 0; i + 1 < kBlock; ++i) {
    const double u = law.cdf(radii[i]) - 0.5;
    with_place += u * ((static_cast<double>(i) + 0.5) / kBlock - 0.5);
    with_next += u * (law.cdf(radii[i + 1]) - 0.5);
  }
  const double five_deviations = 5 * std::sqrt(double{kBlock});
  CHECK(std::abs(12 * with_place) < five_deviations);
  CHECK(std::abs(12 * with_next) < five_deviations);
}

// Reference means come from a separate simulation (400 and 100 draws of the powder with another generator); the margins
// are four standard errors of sixty draws.
TEST_CASE("independent drawing has a floor of the Hellinger distance, stratified drawing lies below") {
  const SizeLaw law(lognormal_psd(), 3);
  const Floor random_n = sampling_floor(law, Sampler::random, 0);
  const Floor random_v = sampling_floor(law, Sampler::random, 3);
  const Floor stratified_n = sampling_floor(law, Sampler::stratified, 0);
  const Floor stratified_v = sampling_floor(law, Sampler::stratified, 3);
  CHECK(random_n.mean == Approx(0.0162).margin(0.0010));
  CHECK(random_v.mean == Approx(0.2149).margin(0.0150));
  CHECK(stratified_n.mean == Approx(0.0094).margin(0.0005));
  CHECK(stratified_v.mean == Approx(0.1889).margin(0.0120));
  // By volume the floor is set by coarse bins that expect less than one sphere, which no stratum can split.
  CHECK(stratified_n.mean < 0.65 * random_n.mean);
  CHECK(stratified_v.mean < 0.95 * random_v.mean);
  // The H_V of 0.232 published for drop-and-roll is an ordinary value of perfect independent draws.
  CHECK(std::abs(0.232 - random_v.mean) < random_v.sd);
}

TEST_CASE("the same stream gives the same bytes, another stream others") {
  for (const auto& [name, psd] : continuous_examples()) {
    CAPTURE(name);
    for (const Sampler kind : {Sampler::random, Sampler::stratified}) {
      const SizeLaw law(psd, 2);
      const auto first = draw_radii(law, kind, 1000, RandomStream("key", 5));
      CHECK(same_bytes(first, draw_radii(SizeLaw(psd, 2), kind, 1000, RandomStream("key", 5))));
      CHECK_FALSE(same_bytes(first, draw_radii(law, kind, 1000, RandomStream("key", 6))));
    }
  }
}

TEST_CASE("no radii and no block") {
  const SizeLaw law(lognormal_psd(), 3);
  CHECK(draw_radii(law, Sampler::stratified, 0, RandomStream("none", 0)).empty());
  CHECK_THROWS_AS(RadiusSampler(law, Sampler::random, 0, RandomStream("none", 0)), InputError);
}
