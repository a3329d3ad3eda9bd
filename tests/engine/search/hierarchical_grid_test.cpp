// The grid finds what a look at every sphere finds.
#include "engine/base/random.h"
#include "engine/search/hierarchical_grid.h"
#include "engine/search/skyline.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>

using namespace tamp;

namespace {

template <int D>
struct Cloud {
  Vec<D> size;
  std::array<bool, D> periodic{};
  std::vector<Vec<D>> centres;
  std::vector<double> radii;
};

/// Spheres of radii over three decades (overlapping ones: the grid does not care) in an oblong box.
template <int D>
Cloud<D> random_cloud(std::uint64_t seed, bool periodic, std::size_t n) {
  RandomStream random("grid", seed);
  Cloud<D> cloud;
  for (int a = 0; a < D; ++a) {
    cloud.size[a] = 1 + 2 * random.uniform();
    cloud.periodic[static_cast<std::size_t>(a)] = periodic && a < D - 1;
  }
  for (std::size_t i = 0; i < n; ++i) {
    Vec<D> c;
    for (int a = 0; a < D; ++a)
      c[a] = random.uniform() * cloud.size[a];
    cloud.centres.push_back(c);
    cloud.radii.push_back(0.2 * std::pow(10, -3 * random.uniform()));
  }
  return cloud;
}

template <int D>
HierarchicalGrid<D> filled(const Cloud<D>& cloud, double expected) {
  std::vector<SizeClass> classes;
  for (double top = 0.2; top > 1e-4; top /= 2)
    classes.push_back({top, expected});
  HierarchicalGrid<D> grid(cloud.size, cloud.periodic, classes);
  for (std::size_t i = 0; i < cloud.radii.size(); ++i)
    grid.insert(cloud.centres[i], cloud.radii[i]);
  return grid;
}

/// Calls f for every image of every sphere up to three boxes away.
template <int D, class F>
void for_each_image(const Cloud<D>& cloud, F&& f) {
  const auto turns = [&](int axis) { return axis < D - 1 && cloud.periodic[static_cast<std::size_t>(axis)] ? 3 : 0; };
  for (std::size_t i = 0; i < cloud.radii.size(); ++i) {
    for (int x = -turns(0); x <= turns(0); ++x) {
      for (int y = -turns(1); y <= turns(1); ++y) {
        Vec<D> image = cloud.centres[i];
        image[0] += x * cloud.size[0];
        image[1] += y * cloud.size[1];
        f(image, cloud.radii[i]);
      }
    }
  }
}

template <int D>
void agrees_with_brute_force(bool periodic) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto cloud = random_cloud<D>(seed, periodic, 150);
    // Every other grid is told of so few spheres that it must make its cells anew, time and again.
    const auto grid = filled(cloud, seed % 2 == 0 ? 15 : 1);
    RandomStream random("queries", seed);
    for (int query = 0; query < 20; ++query) {
      Vec<D> p;
      for (int a = 0; a < D; ++a)
        p[a] = (1.4 * random.uniform() - 0.2) * cloud.size[a];
      const double reach = 0.4 * random.uniform();

      std::vector<double> found;
      std::vector<double> expected;
      grid.for_each_near(p, reach, [&](const Vec<D>& c, double r) { found.push_back((c - p).norm() - r); });
      for_each_image(cloud, [&](const Vec<D>& c, double r) {
        if ((c - p).squaredNorm() <= (r + reach) * (r + reach))
          expected.push_back((c - p).norm() - r);
      });
      std::sort(found.begin(), found.end());
      std::sort(expected.begin(), expected.end());
      REQUIRE(found.size() == expected.size());
      for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(found[i] == Approx(expected[i]).margin(1e-14));

      // A body of radius `reach` on its way down misses nothing that it could touch.
      const double travel = 0.2 * random.uniform();
      std::vector<double> ahead;
      grid.for_each_ahead(p, reach, travel, [&](const Vec<D>& c, double r) { ahead.push_back((c - p).norm() - r); });
      std::sort(ahead.begin(), ahead.end());
      for_each_image(cloud, [&](const Vec<D>& c, double r) {
        const double gap = (c - p).norm() - r;
        if (gap > reach + travel || c[vertical<D>] > p[vertical<D>] + r + reach)
          return;
        const auto next = std::lower_bound(ahead.begin(), ahead.end(), gap - 1e-13);
        REQUIRE(next != ahead.end());
        CHECK(*next == Approx(gap).margin(1e-13));
      });
      CHECK((ahead.empty() || ahead.back() <= reach + travel));

      // The same cloud seen by a body of radius `reach` falling from p: where its centre stops.
      const auto landing = [&](const Vec<D>& c, double r) {
        const double lateral2 = (p - c).template head<D - 1>().squaredNorm();
        const double touch = r + reach;
        const bool lands = lateral2 < touch * touch && c[vertical<D>] <= p[vertical<D>];
        return lands ? c[vertical<D>] + std::sqrt(touch * touch - lateral2) : 0.0;
      };
      double stopped = 0;
      grid.for_each_below(p, reach, stopped,
                          [&](const Vec<D>& c, double r) { return stopped = std::max(stopped, landing(c, r)); });
      double brute = 0;
      for_each_image(cloud, [&](const Vec<D>& c, double r) { brute = std::max(brute, landing(c, r)); });
      CHECK(stopped == Approx(brute).margin(1e-14));
    }
  }
}

} // namespace

TEST_CASE("the hierarchical grid finds the same spheres as a look at all of them") {
  SECTION("2D, bounded") {
    agrees_with_brute_force<2>(false);
  }
  SECTION("2D, periodic sides") {
    agrees_with_brute_force<2>(true);
  }
  SECTION("3D, bounded") {
    agrees_with_brute_force<3>(false);
  }
  SECTION("3D, periodic sides") {
    agrees_with_brute_force<3>(true);
  }
}

TEST_CASE("nothing stands above the skyline") {
  for (const bool periodic : {false, true}) {
    const auto cloud = random_cloud<3>(7, periodic, 100);
    Skyline<3> skyline(cloud.size, cloud.periodic, 64);
    for (std::size_t i = 0; i < cloud.radii.size(); ++i)
      skyline.raise(cloud.centres[i], cloud.radii[i]);
    RandomStream random("skyline", 1);
    for (int query = 0; query < 200; ++query) {
      const Vec<3> p(random.uniform() * cloud.size[0], random.uniform() * cloud.size[1], 0);
      const double radius = 0.3 * random.uniform();
      double top = 0;
      for_each_image(cloud, [&](const Vec<3>& c, double r) {
        if ((c - p).head<2>().norm() < r + radius)
          top = std::max(top, c[2] + r);
      });
      CHECK(skyline.above(p, radius) >= top);
      CHECK(skyline.above(p, 2 * cloud.size.maxCoeff()) <= cloud.size[2] + 0.2);
    }
  }
}
