// Descents where a contact only just is one: grazes, throats, ridges, corners and supports that nearly fail.
#include "engine/base/random.h"
#include "tests/engine/watched_bed.h"

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr double kTop = 14; ///< where spheres are dropped

/// 0, and ± powers of ten from far below the tolerance of contacts to far above it.
std::vector<double> small_shares() {
  std::vector<double> shares = {0};
  for (double share = 1e-16; share < 0.1; share *= 10) {
    for (const double mantissa : {1.0, 3.7})
      shares.insert(shares.end(), {share * mantissa, -share * mantissa});
  }
  return shares;
}

} // namespace

TEST_CASE("hard geometry: a falling sphere grazes the equator of another") {
  for (const double share : small_shares()) {
    INFO("share " << share);
    for (const double other : {1.0, 0.01, 3.0}) {
      Bed<2> plane;
      plane.add({8, 6}, other);
      drop(plane, {8 + (1 + other) * (1 + share), kTop});
      Bed<3> space;
      space.add({8, 8, 6}, other);
      drop(space, {8 + 0.6 * (1 + other) * (1 + share), 8 + 0.8 * (1 + other) * (1 + share), kTop});
    }
  }
}

TEST_CASE("hard geometry: a rolling sphere grazes another beside its path") {
  for (const double share : small_shares()) {
    INFO("share " << share);
    Bed<3> beside; // the path around the first sphere runs in the plane y = 8
    beside.add({8, 8, 6}).add({9.5, 8 + 2 * (1 + share), 6 + std::sqrt(4 - 1.5 * 1.5)});
    drop(beside, {8.01, 8, kTop});
    Bed<3> both = beside;
    both.add({9.5, 8 - 2 * (1 + share), 6 + std::sqrt(4 - 1.5 * 1.5)});
    drop(both, {8.01, 8, kTop});

    // Above: the path passes under a sphere that hangs over it.
    Bed<2> above;
    const double far = 4 * (1 + share);
    above.add({8, 6}).add({8 + 0.8 * far, 6 + 0.6 * far});
    drop(above, {8.01, kTop});
    // At the end: the floor, or the flank of a third sphere, is met where the path leaves the first one's equator.
    Bed<2> leaving;
    leaving.add({8, 6}).add({8 + 4 * (1 + share), 6});
    drop(leaving, {8.01, kTop});
    Bed<2> landing;
    landing.add({8, 1 + share});
    drop(landing, {8.01, kTop});
  }
}

TEST_CASE("hard geometry: three supports near one vertical plane") {
  for (const double share : small_shares()) {
    for (const double along : {0.0, 0.2, 1e-9}) {
      INFO("share " << share << ", along " << along);
      Bed<3> row; // two supports, and a small third one that the sphere between them touches from above
      const double top = 1 + std::sqrt(4 - 1.05 * 1.05);
      row.add({7, 8, 1}).add({9.1, 8, 1});
      row.add({8.05 - 1.05 * std::sin(0.3), 8 + share, top - 1.05 * std::cos(0.3)}, 0.05);
      drop(row, {8.05 + along, 8, kTop});
      drop(row, {8.05 + along, 8 + share, kTop});
      Bed<3> ridge; // two supports across a ridge, and a low one that catches the sphere on its way down
      ridge.add({7, 8, 3}).add({9, 8, 3}).add({8 + along, 8 + 2 + share, 3});
      drop(ridge, {8, 8 + 1e-3, kTop});
      drop(ridge, {8, 8 - share, kTop});
      drop(ridge, {8 - along, 8, kTop});
    }
  }
}

TEST_CASE("hard geometry: a large sphere on small ones whose normals nearly agree") {
  RandomStream random("pebbles", 1);
  for (const double ratio : {10.0, 100.0, 1000.0, 10000.0}) {
    INFO("ratio " << ratio);
    const double small = 1 / ratio;
    Bed<3> space;
    Bed<2> plane;
    for (int i = 0; i < 6; ++i) {
      space.add({8 + 2.5 * small * i, 8, small}, small).add({8 + 2.5 * small * i, 8 + 2.5 * small, small}, small);
      plane.add({8 + 2.5 * small * i, small}, small);
    }
    for (int i = 0; i < 10; ++i) {
      drop(space, {8 + 14 * small * random.uniform(), 8 + 2 * small * random.uniform(), kTop});
      drop(plane, {8 + 14 * small * random.uniform(), kTop});
    }
    drop(space, {8 + 2.5 * small, 8 + 1.25 * small, kTop});
    drop(plane, {8 + 2.5 * small, kTop});
  }
}

TEST_CASE("hard geometry: an apex balanced exactly, or nearly so, on the top of a sphere") {
  for (const double share : small_shares()) {
    INFO("share " << share);
    Bed<2> plane;
    plane.add({8, 1});
    CHECK(drop(plane, {8 + share, kTop})[1] == Approx(1).epsilon(1e-14));
    Bed<3> space;
    space.add({8, 8, 1});
    CHECK(drop(space, {8 + share, 8 - share, kTop})[2] == Approx(1).epsilon(1e-14));
    // A tower, whose top sphere comes down from ledge to ledge.
    space.add({8, 8, 3}).add({8, 8, 5});
    CHECK(drop(space, {8, 8 + share, kTop})[2] == Approx(1).epsilon(1e-14));
    // Sides that are taken: each neighbour as high as the apex and touching the balanced sphere.
    Bed<3> fenced;
    fenced.add({8, 8, 3});
    for (const double side : {-1.0, 1.0}) {
      fenced.add({8 + side * 2, 8, 5});
      CHECK(drop(fenced, {8 + share, 8, kTop})[2] <= 5.0 + 1e-9);
      fenced.add({8, 8 + side * 2, 5});
      CHECK(drop(fenced, {8, 8 + share, kTop})[2] <= 5.0 + 1e-9);
    }
    // A ball against a wall, on the top of one that leans on it, too.
    Bed<3> leaning;
    leaning.add({1, 8, 1});
    drop(leaning, {1 + std::abs(share), 8, kTop});
    leaning.add({1, 10, 3}).add({1, 6, 3});
    drop(leaning, {1, 8, kTop});
    drop(leaning, {1 + std::abs(share), 8 + share, kTop});
  }
}

TEST_CASE("hard geometry: two, three and four equal supports, dropped on exactly or nearly between them") {
  for (const double share : small_shares()) {
    for (const double half : {0.2, 1.0, 1.5, 1.9999999}) {
      INFO("share " << share << ", half distance " << half);
      const double top = 3 + std::sqrt(4 - half * half);
      Bed<2> plane;
      plane.add({8 - half, 3}, 1).add({8 + half, 3}, 1);
      if (half >= 1)
        CHECK(drop(plane, {8 + share, kTop})[1] == Approx(top).epsilon(1e-9));
      if (half < 1)
        continue;
      Bed<3> saddle;
      saddle.add({8 - half, 8, 3}).add({8 + half, 8, 3});
      CHECK(drop(saddle, {8, 8 + share, kTop})[2] == Approx(1).epsilon(1e-12));
      CHECK(drop(saddle, {8 + share, 8, kTop})[2] == Approx(1).epsilon(1e-12));
      // At the foot of the saddle two equal spheres, met at the same instant or nearly so.
      Bed<3> cross = saddle;
      cross.add({8 - half, 8 + 2.5, 2 + share}).add({8 + half, 8 + 2.5, 2});
      drop(cross, {8, 8 + 1e-3, kTop});
      cross.add({8, 8 - 2.5, 2});
      drop(cross, {8, 8, kTop});
    }
    Bed<3> three;
    for (int i = 0; i < 3; ++i)
      three.add({8 + 1.2 * std::cos(2.0943951023931953 * i), 8 + 1.2 * std::sin(2.0943951023931953 * i), 3});
    CHECK(drop(three, {8 + share, 8 - share, kTop})[2] == Approx(3 + std::sqrt(4 - 1.44)).epsilon(1e-9));
    Bed<3> four;
    for (const double x : {-1.1, 1.1}) {
      for (const double y : {-1.1, 1.1})
        four.add({8 + x, 8 + y, 3 + (x * y > 0 ? share : 0)});
    }
    CHECK(drop(four, {8, 8, kTop})[2] == Approx(3 + std::sqrt(4 - 2.42)).margin(2 * std::abs(share) + 1e-9));
    CHECK(drop(four, {8 + 0.1, 8 + share, kTop})[2] ==
          Approx(3 + std::sqrt(4 - 2.42)).margin(2 * std::abs(share) + 1e-9));
  }
}

TEST_CASE("hard geometry: corners of walls and a sphere") {
  for (const double share : small_shares()) {
    INFO("share " << share);
    const double inside = std::abs(share);
    for (const double off : {1.0, 1.0 + inside, 1.5, 1 + std::sqrt(2.0), 3.0, 3.0 + share}) {
      INFO("offset " << off);
      Bed<3> corner;
      corner.add({off, off, 1});
      drop(corner, {1, 1, kTop});
      drop(corner, {1 + inside, 1, kTop});
      drop(corner, {1 + inside, 1 + 2 * inside, kTop});
      drop(corner, {off, off, kTop});
      Bed<2> edge;
      edge.add({off, 1});
      drop(edge, {1, kTop});
      drop(edge, {1 + inside, kTop});
    }
    // A shaft that the sphere barely fits in, one or both ways; exactly where the share is 0.
    for (const double depth : {2 * (1 + inside), 16.0}) {
      INFO("depth " << depth);
      Bed<3> shaft;
      shaft.size = {2 * (1 + inside), depth, 16};
      shaft.add({1, 1, 1}).add({1 + inside, 1 + inside, 4});
      drop(shaft, {1, 1, kTop});
      drop(shaft, {1 + 2 * inside, 1 + inside, kTop});
      if (depth > 2.5) {
        shaft.add({1, 3, 1 + share * share});
        drop(shaft, {1 + inside, 2, kTop});
      }
    }
    Bed<2> slot;
    slot.size = {2 * (1 + inside), 16};
    slot.add({1, 1});
    drop(slot, {1, kTop});
    drop(slot, {1 + inside, kTop});
  }
}

namespace {

/// Spheres of radius `ring` around the vertical axis through (8, 8), that leave a throat of radius 1 + excess.
void add_ring(Bed<3>& bed, int count, double ring, double excess, double height) {
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * i / count + 0.1;
    bed.add({8 + (1 + ring + excess) * std::cos(angle), 8 + (1 + ring + excess) * std::sin(angle), height}, ring);
  }
}

/// Whether what came to rest must have passed the throat, must not have, or may have done either as its width differs
/// from the sphere's by less than contacts are exact.
void check_passage(double height, double throat, double excess) {
  if (excess > 2 * kTouch)
    CHECK(height < throat - 0.5);
  if (excess < -2 * kTouch)
    CHECK(height > throat);
}

} // namespace

TEST_CASE("hard geometry: throats of barely the sphere's own size, too narrow and too wide from 1e-16") {
  for (const double share : small_shares()) {
    INFO("share " << share);
    for (const double aside : {0.0, 1e-12, 0.3}) {
      INFO("aside " << aside);
      Bed<2> discs;
      discs.add({8 - 2 - share, 5}).add({8 + 2 + share, 5});
      check_passage(drop(discs, {8 + aside, kTop})[1], 5, share);
      Bed<2> slope; // beside a wall
      slope.add({3 + share, 5});
      check_passage(drop(slope, {1 + aside, kTop})[1], 5, share);
      Bed<3> wall;
      wall.add({3 + share, 8 - 0.9, 5}).add({3 + share, 8 + 0.9, 5}, 0.9);
      drop(wall, {1 + aside, 8, kTop});
      for (const int count : {3, 4, 6}) {
        for (const double ring : {0.9, 0.2}) {
          Bed<3> bed;
          add_ring(bed, count, ring, share, 5);
          const Vec<3> p = drop(bed, {8 + aside, 8 + 0.5 * aside, kTop});
          if (ring * count > 2.9)
            check_passage(p[2], 5, share);
        }
      }
    }
  }
}

TEST_CASE("hard geometry: a fall through a pipe of throats, each as wide as the sphere within rounding") {
  RandomStream random("pipe", 1);
  for (const double width : {0.0, 1e-16, 1e-14, 1e-12, 1e-11, 1e-10, 1e-8}) {
    INFO("width " << width);
    for (int trial = 0; trial < 5; ++trial) {
      Bed<3> pipe;
      Bed<2> gap;
      for (int level = 0; level < 5; ++level) {
        add_ring(pipe, 3, 0.9, width * (2 * random.uniform() - 0.5), 2 + 1.9 * level);
        gap.add({6 - width * random.uniform(), 2.0 + 2 * level}).add({10 + width * random.uniform(), 2.0 + 2 * level});
      }
      drop(pipe, {8, 8, kTop});
      drop(pipe, {8 + 0.4 * random.uniform(), 8, kTop});
      drop(gap, {8, kTop});
      drop(gap, {8.3, kTop});
    }
  }
}
