// Single descents with known ends: closed forms, exact symmetries, corners.
#include "engine/base/random.h"
#include "engine/generate/drop_and_roll/descent.h"

#include <catch2/catch.hpp>

using namespace tamp;

namespace {

/// A box of edge 10 with given spheres, ready for one more to be dropped in.
template <int D>
class Bed {
public:
  explicit Bed(bool periodic = false, double edge = 10) : size_(Vec<D>::Constant(edge)) {
    periodic_.fill(periodic);
    periodic_[static_cast<std::size_t>(vertical<D>)] = false;
    const std::vector<SizeClass> classes = {{8, 1}, {4, 1}, {2, 8}, {1, 64}, {0.5, 64}, {0.05, 64}};
    grid_ = std::make_unique<HierarchicalGrid<D>>(size_, periodic_, classes);
  }
  Bed& add(const Vec<D>& centre, double radius) {
    grid_->insert(centre, radius);
    spheres_.push_back({centre, radius});
    return *this;
  }
  /// Where a sphere dropped from p comes to rest; fails the test if it does not.
  Vec<D> drop(Vec<D> p, double radius) const {
    const double start = p[vertical<D>];
    Descent<D> descent(size_, periodic_, *grid_);
    REQUIRE(descent.run(p, radius) == Descent<D>::End::stable);
    CHECK(p[vertical<D>] <= start);
    for (const auto& [centre, r] : spheres_)
      CHECK((centre - p).norm() - r - radius >= -1e-10 * std::min(r, radius));
    return p;
  }

private:
  Vec<D> size_;
  std::array<bool, D> periodic_{};
  std::unique_ptr<HierarchicalGrid<D>> grid_;
  std::vector<std::pair<Vec<D>, double>> spheres_;
};

} // namespace

TEST_CASE("on an empty floor a sphere rests where it fell") {
  const Vec<3> p = Bed<3>().drop({3, 4, 9}, 1);
  CHECK(p == Vec<3>(3, 4, 1));
}

TEST_CASE("a disc comes to rest between two floor discs at the height of the triangle") {
  Bed<2> bed;
  bed.add({4, 1}, 1).add({5.5, 1}, 1);
  const double height = 1 + std::sqrt(4 - 0.75 * 0.75);
  for (const double x : {4.2, 4.75, 5.4}) {
    const Vec<2> p = bed.drop({x, 9}, 1);
    CHECK(p[0] == Approx(4.75).epsilon(1e-14));
    CHECK(p[1] == Approx(height).epsilon(1e-14));
  }
}

TEST_CASE("a sphere in the hollow of three touching ones makes a regular tetrahedron") {
  Bed<3> bed;
  const double s = std::sqrt(3.0);
  bed.add({4, 4, 1}, 1).add({6, 4, 1}, 1).add({5, 4 + s, 1}, 1);
  for (const auto& [x, y] : {std::pair{5.0, 4.6}, {4.9, 4.4}, {5.2, 4.9}}) {
    const Vec<3> p = bed.drop({x, y, 9}, 1);
    CHECK(p[0] == Approx(5).epsilon(1e-13));
    CHECK(p[1] == Approx(4 + s / 3).epsilon(1e-13));
    CHECK(p[2] == Approx(1 + 2 * std::sqrt(2.0 / 3)).epsilon(1e-13));
  }
}

TEST_CASE("a sphere rolls off a single one and comes to the floor at the equator's distance") {
  Bed<3> bed;
  bed.add({5, 5, 1}, 1);
  const Vec<3> p = bed.drop({5.3, 5.4, 9}, 1);
  CHECK(p[2] == Approx(1).epsilon(1e-14));
  CHECK((p - Vec<3>(5, 5, 1)).norm() == Approx(2).epsilon(1e-14));
  CHECK((p[1] - 5) / (p[0] - 5) == Approx(4.0 / 3).epsilon(1e-12)); // in the vertical plane of the first contact
}

TEST_CASE("a sphere balanced exactly on a top comes down on one side") {
  SECTION("3D") {
    Bed<3> bed;
    bed.add({5, 5, 1}, 1);
    CHECK(bed.drop({5, 5, 9}, 1)[2] == Approx(1).epsilon(1e-14));
  }
  SECTION("2D") {
    Bed<2> bed;
    bed.add({5, 1}, 1);
    CHECK(bed.drop({5, 9}, 1)[1] == Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("a sphere dropped exactly between two equal supports leaves the saddle") {
  Bed<3> bed;
  bed.add({4, 5, 1}, 1).add({6, 5, 1}, 1);
  CHECK(bed.drop({5, 5, 9}, 1)[2] == Approx(1).epsilon(1e-12));
}

TEST_CASE("a wall and a sphere below carry a disc; two walls and a sphere carry a sphere in a corner") {
  const double depth = std::sqrt(4 - 0.25);
  Bed<2> plane;
  plane.add({1.5, 1}, 1);
  const Vec<2> disc = plane.drop({1.2, 9}, 1);
  CHECK(disc[0] == Approx(1));
  CHECK(disc[1] == Approx(1 + depth));

  Bed<3> corner;
  corner.add({1.5, 1.5, 1}, 1);
  const Vec<3> p = corner.drop({1.2, 1.3, 9}, 1);
  CHECK(p[0] == Approx(1).epsilon(1e-13));
  CHECK(p[1] == Approx(1).epsilon(1e-13));
  CHECK(p[2] == Approx(1 + std::sqrt(4 - 0.5)).epsilon(1e-13));
}

TEST_CASE("on exactly regular floors every descent ends in a hollow") {
  RandomStream random("floors", 3);
  Bed<3> square;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j)
      square.add({1.0 + 2 * i, 1.0 + 2 * j, 1}, 1);
  }
  const double hollow = 1 + std::sqrt(2.0);
  SECTION("dropped at random") {
    for (int i = 0; i < 200; ++i) {
      const Vec<3> p = square.drop({1 + 8 * random.uniform(), 1 + 8 * random.uniform(), 9}, 1);
      CHECK(p[2] == Approx(hollow).epsilon(1e-12));
    }
  }
  SECTION("dropped on every point of symmetry") {
    for (int i = 0; i <= 8; ++i) {
      for (int j = 0; j <= 8; ++j) {
        const Vec<3> p = square.drop({1.0 + i, 1.0 + j, 9}, 1);
        CHECK(p[2] <= Approx(hollow).epsilon(1e-12));
      }
    }
  }
  SECTION("a row of discs") {
    Bed<2> row;
    for (int i = 0; i < 5; ++i)
      row.add({1.0 + 2 * i, 1}, 1);
    for (int i = 0; i <= 16; ++i) {
      CHECK(row.drop({1 + i / 2.0, 9}, 1)[1] == Approx(1 + std::sqrt(3.0)).epsilon(1e-12));
    }
  }
}

TEST_CASE("a sphere falls through a throat wider than itself and not through a narrower one") {
  for (const double excess : {1e-6, 1e-9}) {
    Bed<3> bed;
    // Four spheres around the origin of a square whose diagonal leaves a throat of radius 1 ± excess between them.
    const double wide = (2 + excess) / std::sqrt(2.0);
    const double narrow = (2 - excess) / std::sqrt(2.0);
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0})
        bed.add({5 + x * wide, 5 + y * wide, 5}, 1);
    }
    CHECK(bed.drop({5, 5, 9}, 1)[2] == Approx(1).epsilon(1e-14));
    Bed<3> tight;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0})
        tight.add({5 + x * narrow, 5 + y * narrow, 5}, 1);
    }
    CHECK(tight.drop({5, 5, 9}, 1)[2] > 5);
  }
}

TEST_CASE("periodic sides: the hollow across the face is the same as inside") {
  Bed<2> bed(true);
  bed.add({0.25, 1}, 1).add({9, 1}, 1);
  const Vec<2> p = bed.drop({9.8, 9}, 1);
  CHECK(p[1] == Approx(1 + std::sqrt(4 - 0.625 * 0.625)).epsilon(1e-14));
  CHECK(p[0] == Approx(9.625).epsilon(1e-14));
}
