// Lattices as orthogonal cells with the places of spheres in them.
#include "engine/generate/lattice.h"

#include "engine/model/size_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace tamp {

namespace {

/// A sphere may miss the box by this share of its radius: rounding must not cost a layer that fits exactly.
constexpr double kFit = 1e-11;

using Place = std::array<double, 3>;

/// A lattice of touching spheres: edges of an orthogonal cell in diameters, and the spheres in it as shares of the
/// edges.
struct Crystal {
  LatticeKind kind;
  int dimension;
  Place cell;
  std::vector<Place> places;
};

const Crystal& crystal(LatticeKind kind) {
  using std::numbers::sqrt2;
  using std::numbers::sqrt3;
  static const std::vector<Crystal> kCrystals = {
      {LatticeKind::square, 2, {1, 1, 0}, {{0, 0, 0}}},
      {LatticeKind::hexagonal, 2, {1, sqrt3, 0}, {{0, 0, 0}, {0.5, 0.5, 0}}},
      {LatticeKind::sc, 3, {1, 1, 1}, {{0, 0, 0}}},
      {LatticeKind::bcc, 3, {2 / sqrt3, 2 / sqrt3, 2 / sqrt3}, {{0, 0, 0}, {0.5, 0.5, 0.5}}},
      {LatticeKind::fcc, 3, {sqrt2, sqrt2, sqrt2}, {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}},
      // Two close-packed layers: the second lies in the hollows of the first.
      {LatticeKind::hcp,
       3,
       {1, sqrt3, 2 * sqrt2 / sqrt3},
       {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 1.0 / 6, 0.5}, {0, 2.0 / 3, 0.5}}},
  };
  return *std::find_if(kCrystals.begin(), kCrystals.end(), [&](const Crystal& c) { return c.kind == kind; });
}

Generated not_applicable(std::string reason) {
  Generated result;
  result.outcome = Outcome::not_applicable;
  result.reason = std::move(reason);
  return result;
}

/// All places of the lattice in the box, cell by cell from the floor up.
std::vector<double> fill(const Crystal& lattice, double radius, const std::vector<double>& size) {
  const auto d = static_cast<std::size_t>(lattice.dimension);
  std::array<std::size_t, 3> cells{1, 1, 1};
  for (std::size_t a = 0; a < d; ++a)
    cells[a] = static_cast<std::size_t>(size[a] / (2 * radius * lattice.cell[a])) + 1;
  std::vector<double> positions;
  // The vertical axis is the slowest; in 2D it is axis 1 and the third loop runs once.
  for (std::size_t c2 = 0; c2 < cells[2]; ++c2) {
    for (std::size_t c1 = 0; c1 < cells[1]; ++c1) {
      for (std::size_t c0 = 0; c0 < cells[0]; ++c0) {
        for (const Place& place : lattice.places) {
          const std::array<std::size_t, 3> c{c0, c1, c2};
          Place x{};
          bool fits = true;
          for (std::size_t a = 0; a < d; ++a) {
            x[a] = radius + 2 * radius * lattice.cell[a] * (static_cast<double>(c[a]) + place[a]);
            fits = fits && x[a] + radius <= size[a] + kFit * radius;
          }
          if (fits)
            positions.insert(positions.end(), x.begin(), x.begin() + lattice.dimension);
        }
      }
    }
  }
  return positions;
}

} // namespace

Generated generate_lattice(const Request& request) {
  const Job& job = request.job;
  const Scene& scene = job.scene;
  const Crystal& lattice = crystal(job.method.lattice.kind);
  if (lattice.dimension != scene.dimension) {
    return not_applicable(
        fmt::format("the lattice {} is {}D, the scene {}D", name_of(lattice.kind), lattice.dimension, scene.dimension));
  }
  const SizeLaw law(scene.psd, lattice.dimension);
  if (law.classes().size() != 1)
    return not_applicable("a lattice has spheres of one size; the scene's law has several");
  if (scene.sides != Sides::walls)
    return not_applicable("a lattice is laid out between walls; the scene's sides are periodic");

  Generated result;
  const double radius = law.smallest();
  result.packing.positions = fill(lattice, radius, scene.size);
  auto count = result.packing.positions.size() / static_cast<std::size_t>(lattice.dimension);
  if (scene.count > 0) {
    const auto wanted = static_cast<std::size_t>(scene.count);
    if (wanted > count)
      return not_applicable(fmt::format("the box has {} places of the lattice, the scene wants {}", count, wanted));
    count = wanted;
    result.packing.positions.resize(count * static_cast<std::size_t>(lattice.dimension));
  }
  result.packing.radii.assign(count, radius);
  result.packing.dimension = lattice.dimension;
  result.packing.unit = scene.unit;
  std::copy(scene.size.begin(), scene.size.end(), result.packing.size.begin());
  std::fill_n(result.packing.boundary.begin(), lattice.dimension, Boundary::wall);
  result.measures.push_back({"N", static_cast<double>(count), "1"});
  if (request.progress)
    request.progress(count);
  return result;
}

} // namespace tamp
