// Loose clouds against brute force: no sphere touches another or one of its images, and none leaves its box.
#include "engine/generate/loose_cloud.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace tamp;

namespace {

/// Radii over a decade, few of them: a sphere and its images are often each other's neighbours.
std::vector<double> some_radii(std::uint64_t seed, std::size_t n) {
  RandomStream random("radii", seed);
  std::vector<double> radii(n);
  for (double& r : radii)
    r = std::pow(10.0, -random.uniform());
  return radii;
}

/// The smallest gap between two spheres or images of them, over the smaller radius. One period around the box suffices
/// as spheres are less wide than it.
template <int D>
double smallest_gap(const Vec<D>& size, const std::array<bool, D>& periodic, const Cloud<D>& cloud) {
  double smallest = std::numeric_limits<double>::infinity();
  int images = 1;
  for (int a = 0; a < D; ++a)
    images *= 3;
  for (std::size_t i = 0; i < cloud.radii.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      for (int image = 0, code = 0; image < images; code = ++image) {
        Vec<D> shift;
        bool real = true;
        for (int a = 0; a < D; ++a, code /= 3) {
          shift[a] = (code % 3 - 1) * size[a];
          real = real && (shift[a] == 0 || periodic[static_cast<std::size_t>(a)]);
        }
        if (!real || (i == j && shift.isZero(0)))
          continue;
        const double gap = (cloud.centres[i] - cloud.centres[j] - shift).norm() - cloud.radii[i] - cloud.radii[j];
        smallest = std::min(smallest, gap / std::min(cloud.radii[i], cloud.radii[j]));
      }
    }
  }
  return smallest;
}

/// Between rounding and nothing.
constexpr double kRounding = -1e-12;

} // namespace

TEMPLATE_TEST_CASE_SIG("spheres of a periodic cloud touch neither each other nor images on any side",
                       "[generate][loose_cloud]", ((int D), D), 2, 3) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto radii = some_radii(seed, 2 + seed);
    const PeriodicCloud<D> result = loose_periodic_cloud<D>(Vec<D>::Ones(), radii, 0.25, RandomStream("places", seed));
    std::array<bool, D> all;
    all.fill(true);
    INFO("seed " << seed);
    REQUIRE(result.cloud.radii.size() == radii.size());
    CHECK(smallest_gap<D>(result.size, all, result.cloud) > kRounding);
    double solid = 0;
    for (const double r : radii)
      solid += D == 2 ? std::numbers::pi * r * r : 4 * std::numbers::pi / 3 * r * r * r;
    CHECK(solid / result.size.prod() <= 0.25 * (1 - kRounding));
  }
}

TEMPLATE_TEST_CASE_SIG("spheres of a cloud above a floor touch neither each other nor walls nor images at the sides",
                       "[generate][loose_cloud]", ((int D), D), 2, 3) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    std::array<bool, D> periodic{};
    periodic[0] = seed % 2 == 0;
    const Vec<D> size = Vec<D>::Constant(4);
    const Cloud<D> cloud = loose_cloud<D>(size, periodic, some_radii(seed, 60), 0.25, RandomStream("places", seed));
    INFO("seed " << seed);
    CHECK(smallest_gap<D>(size, periodic, cloud) > kRounding);
    for (std::size_t i = 0; i < cloud.radii.size(); ++i) {
      for (int a = 0; a < D; ++a) {
        if (periodic[static_cast<std::size_t>(a)])
          continue;
        CHECK(cloud.centres[i][a] >= cloud.radii[i] * (1 + kRounding));
        if (a != vertical<D>)
          CHECK(cloud.centres[i][a] <= size[a] - cloud.radii[i] * (1 + kRounding));
      }
    }
  }
}
