// The near list against all pairs tried one by one, and its promise while spheres move.
#include "engine/base/random.h"
#include "engine/dem/near_list.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tamp;

namespace {

template <int D>
struct Spheres {
  SearchBox<D> box;
  std::vector<Vec<D>> centres;
  std::vector<double> radii;
  std::vector<double> hold;
};

template <int D>
Spheres<D> random_spheres(std::uint64_t seed, unsigned periodic_axes, std::size_t n) {
  RandomStream random("near", seed);
  Spheres<D> s;
  for (int a = 0; a < D; ++a) {
    s.box.size[a] = 1.5 + random.uniform();
    s.box.periodic[static_cast<std::size_t>(a)] = ((periodic_axes >> static_cast<unsigned>(a)) & 1U) != 0;
    s.box.wall[static_cast<std::size_t>(a)] = {true, random.uniform() < 0.5};
  }
  for (std::size_t i = 0; i < n; ++i) {
    Vec<D> c;
    for (int a = 0; a < D; ++a)
      c[a] =
          (s.box.periodic[static_cast<std::size_t>(a)] ? 3 * random.uniform() - 1 : random.uniform()) * s.box.size[a];
    s.centres.push_back(c);
    s.radii.push_back(0.15 * std::pow(10, -1.6 * random.uniform()));
    s.hold.push_back(0.1 * s.radii.back());
  }
  return s;
}

/// Calls f(pair, gap) for every pair of spheres and images up to four periods away.
template <int D, class F>
void for_each_image(const Spheres<D>& s, F&& f) {
  for (std::uint32_t i = 0; i < s.radii.size(); ++i) {
    for (std::uint32_t j = i + 1; j < s.radii.size(); ++j) {
      NearPair<D> pair{i, j, {}};
      Vec<D> apart = s.centres[j] - s.centres[i];
      // In a box wider than all reaches only the nearest image can be near.
      for (int a = 0; a < D; ++a) {
        if (!s.box.periodic[static_cast<std::size_t>(a)])
          continue;
        const double turns = -std::round(apart[a] / s.box.size[a]);
        pair.image[static_cast<std::size_t>(a)] = static_cast<std::int8_t>(turns);
        apart[a] += turns * s.box.size[a];
      }
      f(pair, apart.norm() - s.radii[i] - s.radii[j]);
    }
  }
}

template <int D>
void check_against_all_pairs(std::uint64_t seed, unsigned periodic_axes) {
  constexpr double kMargin = 0.03;
  Spheres<D> s = random_spheres<D>(seed, periodic_axes, D == 2 ? 200 : 120);
  CandidateList<D> list;
  CHECK(list.stale(s.box.size, s.centres));
  list.build(s.box, s.centres, s.radii, s.hold, kMargin);
  CHECK_FALSE(list.stale(s.box.size, s.centres));
  std::vector<NearPair<D>> expected;
  for_each_image(s, [&](const NearPair<D>& pair, double gap) {
    if (gap <= s.hold[pair.i] + s.hold[pair.j] + 2 * kMargin)
      expected.push_back(pair);
  });
  REQUIRE(expected.size() > 5);
  CHECK(std::equal(expected.begin(), expected.end(), list.pairs().begin(), list.pairs().end()));
  std::size_t walls = 0;
  for (std::size_t i = 0; i < s.radii.size(); ++i) {
    for (int a = 0; a < D; ++a) {
      for (std::size_t side = 0; side < 2; ++side) {
        const double x = side == 0 ? s.centres[i][a] : s.box.size[a] - s.centres[i][a];
        if (!s.box.periodic[static_cast<std::size_t>(a)] && s.box.wall[static_cast<std::size_t>(a)][side])
          walls += static_cast<std::size_t>(x <= s.radii[i] + s.hold[i] + 2 * kMargin);
      }
    }
  }
  CHECK(list.walls().size() == walls);

  // As long as the list is not stale, whatever touches or holds is in it.
  RandomStream random("near moves", seed);
  for (int step = 0; step < 50 && !list.stale(s.box.size, s.centres); ++step) {
    for_each_image(s, [&](const NearPair<D>& pair, double gap) {
      if (gap <= s.hold[pair.i] + s.hold[pair.j])
        CHECK(std::binary_search(list.pairs().begin(), list.pairs().end(), pair));
    });
    for (Vec<D>& c : s.centres) {
      for (int a = 0; a < D; ++a)
        c[a] += 0.004 * (2 * random.uniform() - 1) - (a == vertical<D> ? 0.01 : 0);
    }
  }
  CHECK(list.stale(s.box.size, s.centres));
}

} // namespace

TEST_CASE("the near list has the pairs and walls that all pairs tried one by one have, and keeps its promise") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const unsigned periodic_axes : {0U, 1U, 3U, 7U}) {
      check_against_all_pairs<2>(seed, periodic_axes);
      check_against_all_pairs<3>(seed, periodic_axes);
    }
  }
}

TEST_CASE("what all spheres move alike makes no list of a periodic box stale") {
  Spheres<3> s = random_spheres<3>(1, 7U, 50);
  CandidateList<3> list;
  list.build(s.box, s.centres, s.radii, s.hold, 0.01);
  for (Vec<3>& c : s.centres)
    c += Vec<3>(0.3, -0.2, 0.5);
  CHECK_FALSE(list.stale(s.box.size, s.centres));
  s.centres[7][0] += 0.02;
  CHECK(list.stale(s.box.size, s.centres));
}
