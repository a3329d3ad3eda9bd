// Moving, shrinking, drifting spheres: at every step the list holds each pair that touches, against all pairs tried.
#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/search/neighbour_list.h"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <string>
#include <tuple>

using namespace tamp;

namespace {

constexpr double kSkin = 0.1;

template <int D>
struct Cloud {
  Vec<D> size;
  std::array<bool, D> periodic{};
  std::vector<double> positions;
  std::vector<double> radii;
};

/// Spheres at random places with radii over a size ratio of `rho`, about as dense as a loose bed; box edges differ.
template <int D>
Cloud<D> random_cloud(std::size_t n, double rho, unsigned periodic_axes, RandomStream& draw) {
  Cloud<D> c;
  double volume = 0;
  for (std::size_t i = 0; i < n; ++i) {
    c.radii.push_back(std::pow(rho, -draw.uniform()));
    volume += std::pow(2 * c.radii.back(), D);
  }
  const double edge = std::max(std::pow(volume, 1.0 / D), 2.5);
  for (int a = 0; a < D; ++a) {
    c.size[a] = edge * (1 + 0.5 * draw.uniform());
    c.periodic[static_cast<std::size_t>(a)] = ((periodic_axes >> static_cast<unsigned>(a)) & 1U) != 0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (int a = 0; a < D; ++a)
      c.positions.push_back((1.2 * draw.uniform() - 0.1) * c.size[a]); // some outside
  }
  return c;
}

/// A pair: the spheres, smaller index first, and the whole numbers of boxes between their positions as given.
using Pair = std::tuple<std::size_t, std::size_t, std::array<int, 3>>;

/// Adds the images of j that overlap i: axis by axis, all whole numbers of boxes up to two that leave them near enough.
template <int D>
void add_images(const Cloud<D>& c, std::size_t i, std::size_t j, std::size_t axis, std::array<int, 3> k, double squared,
                std::vector<Pair>& pairs) {
  const double touching = c.radii[i] + c.radii[j];
  if (squared > touching * touching)
    return;
  if (axis == D) {
    pairs.emplace_back(i, j, k);
    return;
  }
  const double apart = c.positions[j * D + axis] - c.positions[i * D + axis];
  for (int boxes = c.periodic[axis] ? -2 : 0; boxes <= (c.periodic[axis] ? 2 : 0); ++boxes) {
    k[axis] = boxes;
    const double x = apart + boxes * c.size[static_cast<int>(axis)];
    add_images(c, i, j, axis + 1, k, squared + x * x, pairs);
  }
}

/// Pairs that overlap, by trying all of them in all images.
template <int D>
std::vector<Pair> overlapping(const Cloud<D>& c) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < c.radii.size(); ++i) {
    for (std::size_t j = i + 1; j < c.radii.size(); ++j)
      add_images(c, i, j, 0, {}, 0, pairs);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// The list's pairs that overlap, as above; each entry must belong to the smaller sphere.
template <int D>
std::vector<Pair> listed(const Cloud<D>& c, const NeighbourList<D>& list) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < c.radii.size(); ++i) {
    for (const Neighbour n : list.of(i)) {
      const std::size_t j = n.index();
      REQUIRE((c.radii[i] < c.radii[j] || (c.radii[i] == c.radii[j] && i < j)));
      Vec<D> across;
      std::array<int, 3> k{};
      for (std::size_t a = 0; a < D; ++a) {
        const auto axis = static_cast<int>(a);
        const double shift = list.shift(n.image())[axis];
        k[a] = static_cast<int>(std::lround(shift / c.size[axis])) * (i < j ? 1 : -1);
        across[axis] = c.positions[j * D + a] + shift - c.positions[i * D + a];
      }
      if (across.squaredNorm() <= std::pow(c.radii[i] + c.radii[j], 2))
        pairs.emplace_back(std::min(i, j), std::max(i, j), k);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

struct Tally {
  std::size_t pairs = 0;
  std::size_t repairs = 0;
  std::size_t untouched = 0;
};

/// A walk: most spheres tremble, a few run, the box shrinks, the list must be complete and free of doubles throughout.
template <int D>
Tally walk(std::uint64_t seed, double scale) {
  RandomStream draw("neighbour list", seed);
  const double rho = std::pow(40.0, draw.uniform());
  auto c = random_cloud<D>(40 + draw.below(160), rho, static_cast<unsigned>(draw.below(1U << D)), draw);
  for (auto* numbers : {&c.positions, &c.radii}) {
    for (double& x : *numbers)
      x *= scale;
  }
  c.size *= scale;
  NeighbourList<D> list(c.periodic, c.radii, kSkin);
  Tally tally;
  for (int step = 0; step < 40; ++step) {
    CAPTURE(D, seed, step, rho, c.radii.size());
    const ListUpdate done = list.update(c.size, c.positions);
    tally.untouched += done == ListUpdate::none ? 1 : 0;
    const auto expected = overlapping(c);
    REQUIRE(listed(c, list) == expected);
    tally.pairs += expected.size();
    const double shrink = 1 - 0.003 * draw.uniform();
    const std::size_t runner = draw.below(c.radii.size()); // a rattler, or a giant
    for (std::size_t i = 0; i < c.radii.size(); ++i) {
      for (int a = 0; a < D; ++a) {
        const double step_length = (i == runner ? 0.3 : 0.005) * c.radii[i];
        double& x = c.positions[i * D + static_cast<std::size_t>(a)];
        x = shrink * x + (2 * draw.uniform() - 1) * step_length;
      }
    }
    c.size *= shrink;
  }
  tally.repairs = list.repairs();
  return tally;
}

template <int D>
void walk_seeds(std::uint64_t seeds) {
  Tally sum;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Tally tally = walk<D>(seed, seed % 2 == 0 ? 1.0 : 1e-6);
    sum.pairs += tally.pairs;
    sum.repairs += tally.repairs;
    sum.untouched += tally.untouched;
  }
  // All three ways to bring a list up to date were taken.
  CHECK(sum.pairs > 1000);
  CHECK(sum.repairs > 100);
  CHECK(sum.untouched > 0);
}

} // namespace

TEST_CASE("the list holds every pair that touches, each once, while spheres move and the box shrinks") {
  walk_seeds<2>(24);
  walk_seeds<3>(24);
}

TEST_CASE("the list holds every pair that touches, many seeds", "[slow]") {
  for (std::uint64_t seed = 1000; seed < 1200; ++seed) {
    walk<2>(seed, 1);
    walk<3>(seed, 1);
  }
}

TEST_CASE("a rattler or a giant that runs forces no rebuild, and untouched lists stay as they are") {
  RandomStream draw("runner", 0);
  auto c = random_cloud<3>(3000, 20, 7, draw);
  const auto giant = static_cast<std::size_t>(std::max_element(c.radii.begin(), c.radii.end()) - c.radii.begin());
  NeighbourList<3> list(c.periodic, c.radii, kSkin);
  CHECK(list.update(c.size, c.positions) == ListUpdate::rebuilt);
  CHECK(list.update(c.size, c.positions) == ListUpdate::none);
  for (int step = 1; step <= 6; ++step) {
    c.positions[3 * giant] += 0.12 * c.radii[giant];
    c.positions[3 * 5] += 0.12 * c.radii[5];
    CHECK(list.update(c.size, c.positions) == ListUpdate::repaired);
  }
  CHECK(list.rebuilds() == 1);
  CHECK(list.repairs() == 12);
  CHECK(listed(c, list) == overlapping(c));
}

TEST_CASE("the number of entries a sphere does not grow with the size ratio") {
  const auto entries = [](double rho) {
    RandomStream draw("entries", 0);
    const std::size_t n = 40000;
    Cloud<3> c;
    double volume = 0;
    for (std::size_t i = 0; i < n; ++i) { // X_L = 0.75
      c.radii.push_back(static_cast<double>(i) < static_cast<double>(n) * 3 / std::pow(rho, 3) ? rho : 1.0);
      volume += 4.19 * std::pow(c.radii.back(), 3);
    }
    c.periodic = {true, true, true};
    c.size.setConstant(std::cbrt(volume / 0.6));
    for (std::size_t i = 0; i < 3 * n; ++i)
      c.positions.push_back(draw.uniform() * c.size[0]);
    NeighbourList<3> list(c.periodic, c.radii, kSkin);
    list.update(c.size, c.positions);
    return static_cast<double>(list.entries()) / static_cast<double>(n);
  };
  CHECK(entries(20) < entries(2));
}

TEST_CASE("the list is the same on one thread and on two, entry by entry") {
  const auto run = [](std::size_t threads) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    RandomStream draw("list threads", 0);
    auto c = random_cloud<3>(6000, 10, 5, draw);
    NeighbourList<3> list(c.periodic, c.radii, kSkin);
    std::vector<std::vector<Neighbour>> lists;
    for (int step = 0; step < 4; ++step) {
      list.update(c.size, c.positions);
      for (std::size_t i = 0; i < c.radii.size(); ++i)
        lists.emplace_back(list.of(i).begin(), list.of(i).end());
      for (std::size_t k = 0; k < 20; ++k)
        c.positions[3 * draw.below(6000)] += 0.02;
    }
    CHECK(list.repairs() > 0);
    return lists;
  };
  CHECK(run(1) == run(2));
}

TEST_CASE("a periodic box too small for its largest sphere is refused") {
  const std::vector<double> radii{1};
  std::vector<double> positions{0, 0};
  NeighbourList<2> list({true, false}, radii, kSkin);
  CHECK_THROWS_AS(list.update({2.1, 9}, positions), Error);
  CHECK(list.update({2.3, 1}, positions) == ListUpdate::rebuilt); // a bounded axis may be as narrow as it likes
}
