// Every pair the search finds, against all pairs tried one by one; order, threads and cost.
#include "engine/base/random.h"
#include "engine/search/contact_search.h"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <string>
#include <tuple>

using namespace tamp;

namespace {

template <int D>
struct Spheres {
  SearchBox<D> box;
  std::vector<double> positions;
  std::vector<double> radii;
};

/// Spheres at random places, some outside the box, their radii uniform in log over `decades`, the largest 0.2.
template <int D>
Spheres<D> random_spheres(std::size_t n, double decades, unsigned periodic_axes, RandomStream& draw) {
  Spheres<D> s;
  for (int a = 0; a < D; ++a) {
    s.box.size[a] = 0.5 + draw.uniform();
    s.box.periodic[static_cast<std::size_t>(a)] = ((periodic_axes >> static_cast<unsigned>(a)) & 1U) != 0;
    s.box.wall[static_cast<std::size_t>(a)] = {true, draw.uniform() < 0.5};
  }
  for (std::size_t i = 0; i < n; ++i) {
    s.radii.push_back(0.2 * std::pow(10.0, -decades * draw.uniform()));
    for (int a = 0; a < D; ++a)
      s.positions.push_back((1.4 * draw.uniform() - 0.2) * s.box.size[a]);
  }
  return s;
}

/// What a pair is known by: the two spheres, smaller number first, the vector between them, the gap.
using Found = std::tuple<std::size_t, std::size_t, std::array<double, 3>, double>;

template <int D>
std::vector<Found> searched(const Spheres<D>& s, double gap) {
  std::vector<Found> found;
  ContactSearch<D>(s.box, s.positions, s.radii).for_each_pair(gap, [&](const SpherePair<D>& pair) {
    std::array<double, 3> v{};
    // A sphere and its own image may be reported by either of two opposite images: the twin below keeps this one.
    const double sign = pair.i <= pair.j ? 1 : -1;
    for (int a = 0; a < D; ++a)
      v[static_cast<std::size_t>(a)] = sign * pair.normal[a];
    found.emplace_back(std::min(pair.i, pair.j), std::max(pair.i, pair.j), v, pair.gap);
  });
  std::sort(found.begin(), found.end());
  return found;
}

template <int D>
std::vector<Found> tried_one_by_one(const Spheres<D>& s, double gap, int images) {
  std::vector<Found> found;
  std::array<int, 3> range{};
  for (std::size_t a = 0; a < D; ++a)
    range[a] = s.box.periodic[a] ? images : 0;
  for (std::size_t i = 0; i < s.radii.size(); ++i) {
    for (std::size_t j = i; j < s.radii.size(); ++j) {
      for (int k0 = -range[0]; k0 <= range[0]; ++k0) {
        for (int k1 = -range[1]; k1 <= range[1]; ++k1) {
          for (int k2 = -range[2]; k2 <= range[2]; ++k2) {
            const std::array<int, 3> k{k0, k1, k2};
            if (i == j && k <= std::array<int, 3>{})
              continue;
            Vec<D> across;
            for (int a = 0; a < D; ++a) {
              const auto at = static_cast<std::size_t>(a);
              across[a] = (s.positions[j * D + at] - s.positions[i * D + at]) + k[at] * s.box.size[a];
            }
            const double distance = across.norm();
            const double surface = distance - (s.radii[i] + s.radii[j]);
            if (surface > gap * std::min(s.radii[i], s.radii[j]))
              continue;
            std::array<double, 3> v{};
            for (int a = 0; a < D; ++a)
              v[static_cast<std::size_t>(a)] = across[a] / distance;
            found.emplace_back(i, j, v, surface);
          }
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

template <int D>
void compare_with_twin(int seeds) {
  std::size_t pairs = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    RandomStream draw("contact search", static_cast<std::uint64_t>(seed));
    const auto s =
        random_spheres<D>(1 + draw.below(300), 3 * draw.uniform(), static_cast<unsigned>(draw.below(1U << D)), draw);
    const double gap = draw.uniform() < 0.5 ? 0 : draw.uniform();
    CAPTURE(D, seed, gap, s.radii.size());
    const auto expected = tried_one_by_one(s, gap, 3);
    REQUIRE(searched(s, gap) == expected);
    pairs += expected.size();
  }
  CHECK(pairs > 100); // the comparison had something to compare
}

} // namespace

TEST_CASE("the search finds the pairs that trying all of them finds, bit for bit") {
  compare_with_twin<2>(80);
  compare_with_twin<3>(80);
}

TEST_CASE("a sphere in a box of its own width touches its images once an axis") {
  for (const double scale : {1.0, 1e-6}) {
    Spheres<3> s;
    s.box.size = Vec<3>::Constant(2 * scale);
    s.box.periodic = {true, true, true};
    s.positions = {0.3 * scale, 1.9 * scale, -5 * scale};
    s.radii = {scale};
    std::size_t pairs = 0;
    ContactSearch<3>(s.box, s.positions, s.radii).for_each_pair(1e-9, [&](const SpherePair<3>& pair) {
      CHECK(pair.i == pair.j);
      CHECK(std::abs(pair.gap) <= 1e-15 * scale);
      ++pairs;
    });
    CHECK(pairs == 3);
  }
}

TEST_CASE("coincident centres are a pair without a normal") {
  Spheres<2> s;
  s.positions = {0.5, 0.5, 0.5, 0.5};
  s.radii = {0.1, 0.1};
  std::size_t pairs = 0;
  ContactSearch<2>(s.box, s.positions, s.radii).for_each_pair(0, [&](const SpherePair<2>& pair) {
    CHECK(pair.normal.isZero(0));
    CHECK(pair.gap == Approx(-0.2));
    ++pairs;
  });
  CHECK(pairs == 1);
}

TEST_CASE("walls are met on bounded axes that have them") {
  Spheres<2> s;
  s.box.size = {1, 2};
  s.box.periodic = {true, false};
  s.box.wall = {{{true, true}, {true, false}}};
  s.positions = {0.05, 0.1, 0.5, 0.25, 0.5, 1.95};
  s.radii = {0.1, 0.2, 0.1};
  std::vector<WallContact> found;
  ContactSearch<2>(s.box, s.positions, s.radii).for_each_wall(0.25, [&](const WallContact& w) { found.push_back(w); });
  REQUIRE(found.size() == 2); // no wall across the periodic axis, none at the top; a gap of a quarter counts
  CHECK(found[0].i == 0);
  CHECK(found[0].axis == 1);
  CHECK(found[0].side == 0);
  CHECK(found[0].gap == 0);
  CHECK(found[1].gap == Approx(0.05));
}

TEST_CASE("the order of the pairs is the same on one thread and on two") {
  RandomStream draw("contact order", 0);
  const auto s = random_spheres<3>(5000, 1.5, 3, draw);
  const auto run = [&](std::size_t threads) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    std::vector<std::pair<std::size_t, std::size_t>> order;
    ContactSearch<3>(s.box, s.positions, s.radii).for_each_pair(0.1, [&](const SpherePair<3>& pair) {
      order.emplace_back(pair.i, pair.j);
    });
    return order;
  };
  const auto one = run(1);
  CHECK(one.size() > 5000);
  CHECK(one == run(2));
}

TEST_CASE("the cost is linear for size ratio 100") {
  // Volume shares as in a bed: 3 parts large to 1 part small, at a density of about a half.
  const auto seconds = [](std::size_t n) {
    constexpr double kRatio = 100;
    constexpr double kPi = 3.14159265358979323846;
    Spheres<3> s;
    RandomStream draw("contact cost", n);
    const auto large = static_cast<std::size_t>(3 * static_cast<double>(n) / std::pow(kRatio, 3)) + 1;
    const double volume = 4 * static_cast<double>(n) * 4 * kPi / 3 / std::pow(kRatio, 3) / 0.5;
    s.box.size = Vec<3>::Constant(std::cbrt(volume));
    s.box.periodic = {true, true, false};
    for (std::size_t i = 0; i < n + large; ++i) {
      s.radii.push_back(i < n ? 1 / kRatio : 1.0);
      for (int a = 0; a < 3; ++a)
        s.positions.push_back(draw.uniform() * s.box.size[a]);
    }
    const auto start = std::chrono::steady_clock::now();
    std::size_t pairs = 0;
    ContactSearch<3>(s.box, s.positions, s.radii).for_each_pair(1e-6, [&](const SpherePair<3>&) { ++pairs; });
    CHECK(pairs > n / 4);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  (void)seconds(50000); // warm-up
  const double small = seconds(50000);
  const double large = seconds(400000);
  CAPTURE(small, large);
  CHECK(large < 8 * 4 * small); // quadratic would be 64 times; leaves room for caches and a busy machine
}

TEST_CASE("a million lognormal spheres take seconds", "[slow]") {
  constexpr std::size_t kCount = 1000000;
  Spheres<3> s;
  RandomStream draw("million", 0);
  double volume = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double gauss = std::sqrt(-2 * std::log(1 - draw.uniform())) * std::cos(6.283185307179586 * draw.uniform());
    s.radii.push_back(std::clamp(std::exp(0.3 + 0.68 * gauss), 0.1, 50.0));
    volume += 4.18879 * std::pow(s.radii.back(), 3);
  }
  s.box.size = Vec<3>::Constant(std::cbrt(volume / 0.65));
  for (std::size_t i = 0; i < 3 * kCount; ++i)
    s.positions.push_back(draw.uniform() * s.box.size[0]);
  const auto start = std::chrono::steady_clock::now();
  std::size_t pairs = 0;
  ContactSearch<3>(s.box, s.positions, s.radii).for_each_pair(1e-6, [&](const SpherePair<3>&) { ++pairs; });
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CAPTURE(taken, pairs);
  CHECK(pairs > kCount);
  CHECK(taken < 20); // 2 s measured; the rest is for a busy machine
}
