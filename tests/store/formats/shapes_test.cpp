// Voxel images and surfaces have the volume of the spheres, and refuse what they cannot show.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "store/formats/format.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/engine/model/some_packing.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include <cstring>
#include <numbers>

using namespace tamp;
using Catch::Matchers::Contains;

namespace {

/// One sphere across a corner of a box of 4 × 3 × 2.
Packing cornered(Boundary boundary, int dimension = 3) {
  Packing packing;
  packing.dimension = dimension;
  packing.size = {4, 3, dimension == 3 ? 2.0 : 0.0};
  packing.boundary = {boundary, boundary, boundary};
  packing.positions = dimension == 3 ? std::vector<double>{0.1, 0.2, 1.9} : std::vector<double>{0.1, 2.9};
  packing.radii = {0.9};
  return packing;
}

double solid_share(const std::string& image) {
  return static_cast<double>(std::count(image.begin(), image.end(), '\1')) / static_cast<double>(image.size());
}

float float_at(const std::string& bytes, std::size_t at) {
  float value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

} // namespace

TEST_CASE("a voxel image of a periodic sphere has its volume, wherever it lies") {
  const ScratchFolder folder;
  const Format& format = format_named("meta-image");
  ExportOptions options;
  options.voxels = 160;
  format.write(folder / "p.mhd", cornered(Boundary::periodic), options);
  const std::string image = read_file(folder / "p.raw");
  CHECK(image.size() == 160U * 120U * 80U);
  CHECK(solid_share(image) == Approx(4.0 / 3 * std::numbers::pi * 0.729 / 24).epsilon(2e-3));
  CHECK(image[0] == 1);
  CHECK(image.back() == 1);
  const std::string header = read_file(folder / "p.mhd");
  CHECK_THAT(header, Contains("DimSize = 160 120 80\n") && Contains("ElementSpacing = 0.025 0.025 0.025\n") &&
                         Contains("ElementDataFile = p.raw\n") &&
                         Contains("unit um; boundary periodic periodic periodic"));

  options.voxels = 800; // a circle's edge crosses many voxels of its few
  format.write(folder / "disc.mhd", cornered(Boundary::periodic, 2), options);
  const std::string disc = read_file(folder / "disc.raw");
  CHECK(disc.size() == 800U * 600U);
  CHECK(solid_share(disc) == Approx(std::numbers::pi * 0.81 / 12).epsilon(2e-3));
}

TEST_CASE("a voxel image is the point test of each voxel's centre") {
  const ScratchFolder folder;
  Packing packing = test::some_packing(3, 40);
  packing.boundary = {Boundary::wall, Boundary::wall, Boundary::open};
  ExportOptions options;
  options.voxels = 33; // 33 × 10 × 21
  format_named("meta-image").write(folder / "p.mhd", packing, options);
  const std::string image = read_file(folder / "p.raw");
  const double edge = 1.1 / 33;
  REQUIRE(image.size() == 33U * 10U * 21U);
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < image.size(); ++v) {
    const Vec<3> x = edge * Vec<3>(static_cast<double>(v % 33) + 0.5, static_cast<double>(v / 33 % 10) + 0.5,
                                   static_cast<double>(v / 330) + 0.5);
    bool solid = false;
    for (std::size_t i = 0; i < packing.count(); ++i)
      solid = solid || (packing.centre<3>(i) - x).norm() <= packing.radii[i];
    wrong += solid != (image[v] == 1);
  }
  CHECK(wrong == 0);
}

TEST_CASE("an STL surface is closed, looks outwards and has nearly the sphere's volume") {
  const ScratchFolder folder;
  ExportOptions options;
  options.subdivisions = 3;
  format_named("stl").write(folder / "p.stl", cornered(Boundary::wall), options);
  const std::string bytes = read_file(folder / "p.stl");
  const std::size_t triangles = 20 * 64;
  REQUIRE(bytes.size() == 84 + 50 * triangles);
  std::uint32_t stated = 0;
  std::memcpy(&stated, bytes.data() + 80, 4);
  CHECK(stated == triangles);
  double volume = 0; // by the divergence theorem
  Vec<3> area = Vec<3>::Zero();
  for (std::size_t t = 0; t < triangles; ++t) {
    std::array<Vec<3>, 4> p; // normal, then corners
    for (std::size_t k = 0; k < 12; ++k)
      p[k / 3][static_cast<Eigen::Index>(k % 3)] = static_cast<double>(float_at(bytes, 84 + 50 * t + 4 * k));
    const Vec<3> twice = (p[2] - p[1]).cross(p[3] - p[1]);
    REQUIRE(twice.normalized().dot(p[0]) > 0.999);
    volume += p[1].dot(twice) / 6;
    area += twice / 2;
  }
  CHECK(area.norm() < 1e-5);
  CHECK(volume == Approx(4.0 / 3 * std::numbers::pi * 0.729).epsilon(0.02));
}

TEST_CASE("shapes that cannot be written are refused with the reason") {
  const ScratchFolder folder;
  ExportOptions options;
  CHECK_THROWS_WITH(format_named("stl").write(folder / "p", cornered(Boundary::wall, 2), options), Contains("2D"));
  CHECK_THROWS_WITH(format_named("stl").write(folder / "p", test::some_packing(3, 100000), options),
                    Contains("too many"));
  options.voxels = 5; // 3 of 4 edges are no whole number of voxels
  CHECK_THROWS_WITH(format_named("meta-image").write(folder / "p", cornered(Boundary::periodic), options),
                    Contains("no whole number of voxels"));
  options.voxels = 5000;
  CHECK_THROWS_WITH(format_named("meta-image").write(folder / "p", cornered(Boundary::wall), options),
                    Contains("from 1 to 4096"));
  CHECK(folder.size() == 0);
}
