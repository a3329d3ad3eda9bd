// Descents on exactly degenerate beds: faces of lattices, and heaps grown from drops on lattice points only.
#include "engine/base/random.h"
#include "tests/engine/watched_bed.h"

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr double kTop = 14;

/// Layers of spheres of radius 1 in a plane: rows of discs, each straight above the last or in its hollows.
Bed<2> rows(int layers, bool hexagonal) {
  Bed<2> bed;
  for (int k = 0; k < layers; ++k) {
    const bool odd = hexagonal && k % 2 == 1;
    for (int i = 0; i < (odd ? 7 : 8); ++i)
      bed.add({1.0 + 2 * i + (odd ? 1 : 0), 1 + k * (hexagonal ? std::sqrt(3.0) : 2.0)});
  }
  return bed;
}

/// Square layers: straight above each other (simple cubic) or in the hollows (face-centred cubic, face 100).
Bed<3> square_layers(int layers, bool staggered) {
  Bed<3> bed;
  for (int k = 0; k < layers; ++k) {
    const bool odd = staggered && k % 2 == 1;
    for (int i = 0; i < (odd ? 7 : 8); ++i) {
      for (int j = 0; j < (odd ? 7 : 8); ++j)
        bed.add({1.0 + 2 * i + (odd ? 1 : 0), 1.0 + 2 * j + (odd ? 1 : 0), 1 + k * (staggered ? std::sqrt(2.0) : 2.0)});
    }
  }
  return bed;
}

/// Close-packed layers A, B, C, … (face-centred cubic, face 111).
Bed<3> close_packed_layers(int layers) {
  Bed<3> bed;
  const double s = std::sqrt(3.0);
  for (int k = 0; k < layers; ++k) {
    for (int i = -8; i < 9; ++i) {
      for (int j = 0; j < 9; ++j) {
        const Vec<3> p(2 * i + j + (k % 3), 1 + s * j + (k % 3) * s / 3, 1 + k * std::sqrt(8.0 / 3));
        if (p[0] >= 1 && p[0] <= 15 && p[1] <= 15)
          bed.add(p);
      }
    }
  }
  return bed;
}

/// Displacements from a point of symmetry, exact and by rounding and more.
const std::vector<double> kAside = {0, 1e-16, -1e-15, 1e-13, -1e-12, 1e-11, -1e-10, 1e-8, -1e-5, 0.01};

/// Every point of symmetry of squares of edge 1 in the middle of the floor plan, and points beside them.
template <class F>
void for_each_drop(F&& f) {
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      for (const double dx : kAside) {
        for (const double dy : {0.0, dx, -dx, 2e-12})
          f(5 + 0.5 * i + dx, 5 + 0.5 * j + dy);
      }
    }
  }
}

} // namespace

TEST_CASE("hard geometry: square and hexagonal floors of discs") {
  for (const bool hexagonal : {false, true}) {
    for (int layers = 1; layers <= 4; ++layers) {
      const Bed<2> bed = rows(layers, hexagonal);
      const double hollow = bed.spheres.back().centre[1] + std::sqrt(3.0);
      for (int i = 0; i <= 8; ++i) {
        for (const double aside : kAside)
          CHECK(drop(bed, {5 + 0.5 * i + aside, kTop})[1] == Approx(hollow).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("hard geometry: simple cubic floors and the faces 100 and 111 of face-centred cubic ones", "[slow]") {
  for (int layers = 1; layers <= 3; ++layers) {
    const Bed<3> cubic = square_layers(layers, false);
    const Bed<3> face_100 = square_layers(layers, true);
    const Bed<3> face_111 = close_packed_layers(layers);
    for_each_drop([&](double x, double y) {
      INFO(layers << " layers");
      CHECK(drop(cubic, {x, y, kTop})[2] == Approx(2 * layers - 1 + std::sqrt(2.0)).epsilon(1e-9));
      CHECK(drop(face_100, {x, y, kTop})[2] == Approx(1 + layers * std::sqrt(2.0)).epsilon(1e-9));
      CHECK(drop(face_111, {x, y * std::sqrt(3.0) / 2 + 0.7, kTop})[2] ==
            Approx(1 + layers * std::sqrt(8.0 / 3)).epsilon(1e-9));
    });
  }
}

TEST_CASE("hard geometry: periodic floors, also moved by a million box lengths, which a period takes back") {
  // Touching spheres right round a box of whole diameters, moved together with what is dropped; half of them by an
  // irrational share of the box, and all back into it.
  const Bed<3> floor = square_layers(1, false);
  for (const double lengths : {0.0, 1e6, 1e6 + 0.25, -1e6 - 0.1257}) {
    Bed<3> bed = floor;
    bed.periodic = true;
    const auto moved = [&](Vec<3> p) {
      for (int a = 0; a < 2; ++a) {
        const double share = p[a] / bed.size[a] + (lengths - std::trunc(lengths)); // whole lengths are no move
        p[a] = (share - std::floor(share)) * bed.size[a];
      }
      return p;
    };
    for (Sphere<3>& s : bed.spheres)
      s.centre = moved(s.centre);
    for (int i = 0; i <= 16; ++i) {
      for (const double aside : kAside)
        CHECK(drop(bed, moved({static_cast<double>(i), 1 + aside, kTop}))[2] ==
              Approx(1 + std::sqrt(2.0)).epsilon(1e-9));
    }
  }
}

namespace {

/// Drops spheres on random points of a lattice of the given spacing and adds each to the bed, until it is full.
template <int D>
void grow(double spacing, std::span<const double> radii, bool periodic, int drops, RandomStream& random) {
  Bed<D> bed;
  bed.size.setConstant(8);
  bed.periodic = periodic;
  for (int n = 0; n < drops; ++n) {
    const double radius = radii[random.below(radii.size())];
    Vec<D> p = Vec<D>::Constant(20);
    for (int a = 0; a < D - 1; ++a) {
      const double room = periodic ? bed.size[a] : bed.size[a] - 2 * radius;
      const auto points = static_cast<std::uint64_t>(room / spacing) + (periodic ? 0 : 1);
      p[a] = (periodic ? 0 : radius) + spacing * static_cast<double>(random.below(points));
    }
    INFO("drop " << n << ", spacing " << spacing);
    p = drop(bed, p, radius);
    if (p[vertical<D>] > 7)
      continue;
    for (int a = 0; a < D - 1 && periodic; ++a)
      p[a] -= std::floor(p[a] / bed.size[a]) * bed.size[a];
    bed.add(p, radius);
  }
}

} // namespace

TEST_CASE("hard geometry: heaps grown from drops on lattice points", "[slow]") {
  RandomStream random("heaps", 1);
  const std::vector<double> equal = {1};
  const std::vector<double> halves = {1, 0.5};
  const std::vector<double> wide = {1, 0.25, 0.0625};
  for (int repeat = 0; repeat < 4; ++repeat) {
    for (const bool periodic : {false, true}) {
      for (const double spacing : {2.0, 1.0, 0.5, 0.25}) {
        INFO("repeat " << repeat << ", periodic " << periodic);
        grow<2>(spacing, equal, periodic, 40, random);
        grow<2>(spacing, halves, periodic, 60, random);
        grow<2>(spacing, wide, periodic, 100, random);
        grow<3>(spacing, equal, periodic, 150, random);
        grow<3>(spacing, halves, periodic, 250, random);
        grow<3>(spacing, wide, periodic, 300, random);
      }
    }
  }
}
