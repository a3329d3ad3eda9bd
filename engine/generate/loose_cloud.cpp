// Random sequential addition of a cloud, large spheres first.
#include "engine/generate/loose_cloud.h"

#include "engine/search/hierarchical_grid.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <tuple>

namespace tamp {

namespace {

/// Places tried for a sphere before the column grows, and by how much it grows.
constexpr int kTries = 200;
constexpr double kGrowth = 1.05;
/// Ratio of radii within one class of the grid.
constexpr double kClassRatio = 4;
/// A periodic cloud that needs more room gets this share of the packing fraction.
constexpr double kLooser = 0.9;
/// Width of the columns by which spheres are ordered, in mean radii.
constexpr double kColumn = 8;

std::vector<SizeClass> size_classes(const std::vector<double>& falling_radii) {
  std::vector<SizeClass> classes;
  for (const double r : falling_radii) {
    if (classes.empty() || r < classes.back().largest / kClassRatio)
      classes.push_back({r, 0});
    classes.back().expected += 1;
  }
  return classes;
}

} // namespace

template <int D>
Cloud<D> loose_cloud(const Vec<D>& size, const std::array<bool, D>& periodic, std::vector<double> radii, double phi,
                     RandomStream random) {
  constexpr int z = vertical<D>;
  std::sort(radii.begin(), radii.end(), std::greater<>());
  double filled = 0;
  for (const double r : radii)
    filled += (D == 2 ? std::numbers::pi * r : 4.0 / 3.0 * std::numbers::pi * r * r) * r;
  double height = std::max(filled / (phi * size.template head<z>().prod()), 2 * radii.front());

  Vec<D> room = size;
  room[z] = height;
  HierarchicalGrid<D> grid(room, periodic, size_classes(radii));
  Cloud<D> cloud;
  int tries = 0;
  for (std::size_t i = 0; i < radii.size();) {
    const double r = radii[i];
    Vec<D> c;
    for (int a = 0; a < D; ++a) {
      const double edge = a == z ? height : size[a];
      const double low = periodic[static_cast<std::size_t>(a)] ? 0 : r;
      c[a] = low + (edge - 2 * low) * random.uniform();
    }
    bool free = true;
    // A sphere is not to meet its own image either: images are a period away, and it fits into the box.
    grid.for_each_near(c, r, [&](const Vec<D>&, double) { free = false; });
    if (free) {
      grid.insert(c, r);
      cloud.centres.push_back(c);
      ++i;
      tries = 0;
    } else if (++tries == kTries) {
      height *= kGrowth; // the grid's topmost cells hold what lies above them
      tries = 0;
    }
  }

  const double column = kColumn * std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) {
    const Vec<D>& c = cloud.centres[i];
    return std::tuple(D == 2 ? 0.0 : std::floor(c[D - 2] / column), std::floor(c[0] / column), c[z], i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  Cloud<D> ordered;
  for (const std::size_t i : order) {
    ordered.centres.push_back(cloud.centres[i]);
    ordered.radii.push_back(radii[i]);
  }
  return ordered;
}

template <int D>
PeriodicCloud<D> loose_periodic_cloud(const Vec<D>& shape, const std::vector<double>& radii, double phi,
                                      const RandomStream& random) {
  double solid = 0;
  double widest = 0;
  for (const double r : radii) {
    solid += (D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3) * std::pow(r, D);
    widest = std::max(widest, 2 * r);
  }
  // Between floor and lid, since the cloud's search does not go round vertically.
  std::array<bool, D> periodic;
  periodic.fill(true);
  periodic[vertical<D>] = false;
  // Where a cloud finds no room its column grows: then the next one is looser, so that the box keeps its shape.
  for (;; phi *= kLooser) {
    PeriodicCloud<D> result{shape * std::pow(solid / (phi * shape.prod()), 1.0 / D), {}};
    if (!(widest < result.size.minCoeff()))
      continue;
    result.cloud = loose_cloud<D>(result.size, periodic, radii, phi, random);
    double top = 0;
    for (std::size_t i = 0; i < result.cloud.centres.size(); ++i)
      top = std::max(top, result.cloud.centres[i][vertical<D>] + result.cloud.radii[i]);
    if (top <= result.size[vertical<D>])
      return result;
  }
}

template PeriodicCloud<2> loose_periodic_cloud<2>(const Vec<2>&, const std::vector<double>&, double,
                                                  const RandomStream&);
template PeriodicCloud<3> loose_periodic_cloud<3>(const Vec<3>&, const std::vector<double>&, double,
                                                  const RandomStream&);
template Cloud<2> loose_cloud<2>(const Vec<2>&, const std::array<bool, 2>&, std::vector<double>, double, RandomStream);
template Cloud<3> loose_cloud<3>(const Vec<3>&, const std::array<bool, 3>&, std::vector<double>, double, RandomStream);

} // namespace tamp
