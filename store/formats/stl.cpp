// The surface of a small packing as binary STL: each sphere a subdivided icosahedron.
#include "engine/base/error.h"
#include "engine/base/file_writer.h"
#include "store/formats/makers.h"

#include <Eigen/Geometry>

#include <bit>
#include <cmath>

namespace tamp {

namespace {

using Point = Vec<3>;
using Triangle = std::array<Point, 3>;

constexpr std::int64_t kMostSubdivisions = 6;
constexpr double kMostTriangles = 2e7; // a file of a gigabyte

/// Triangles of the unit sphere, corners counter-clockwise from outside.
std::vector<Triangle> unit_sphere(std::int64_t subdivisions) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Point, 12> corners = {Point{-1, g, 0}, {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                         {0, -1, -g},     {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  constexpr std::array<std::array<std::size_t, 3>, 20> kFaces = {
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  std::vector<Triangle> triangles;
  for (const auto& f : kFaces)
    triangles.push_back({corners[f[0]].normalized(), corners[f[1]].normalized(), corners[f[2]].normalized()});
  for (std::int64_t s = 0; s < subdivisions; ++s) {
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const Point ab = (a + b).normalized();
      const Point bc = (b + c).normalized();
      const Point ca = (c + a).normalized();
      for (const Triangle& part : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(part);
    }
    triangles = std::move(finer);
  }
  return triangles;
}

void write_point(FileWriter& out, const Point& p) {
  for (int a = 0; a < 3; ++a) {
    const auto bytes = std::bit_cast<std::array<char, 4>>(static_cast<float>(p[a]));
    out.write({bytes.data(), bytes.size()});
  }
}

} // namespace

void write_stl(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options) {
  if (packing.dimension != 3)
    throw InputError("a packing in 2D has no surface to be written as STL");
  if (options.subdivisions < 0 || options.subdivisions > kMostSubdivisions)
    throw InputError(fmt::format("{} subdivisions; allowed: from 0 to {}", options.subdivisions, kMostSubdivisions));
  const std::vector<Triangle> unit = unit_sphere(options.subdivisions);
  const std::size_t count = unit.size() * packing.count();
  if (static_cast<double>(count) > kMostTriangles)
    throw InputError(fmt::format("{} spheres of {} triangles are too many for STL (at most {:g} triangles); the format "
                                 "meta-image has no such limit",
                                 packing.count(), unit.size(), kMostTriangles));
  FileWriter out(path);
  constexpr std::size_t kHeader = 80;
  std::string header = fmt::format("packing of spheres by tamp, unit {}", name_of(packing.unit));
  header.resize(kHeader, ' ');
  out.write(header);
  const auto number = std::bit_cast<std::array<char, 4>>(static_cast<std::uint32_t>(count));
  out.write({number.data(), number.size()});
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const Point centre = packing.centre<3>(i);
    for (const auto& [a, b, c] : unit) {
      write_point(out, (b - a).cross(c - a).normalized());
      for (const Point& corner : {a, b, c})
        write_point(out, centre + packing.radii[i] * corner);
      out.write({"\0\0", 2});
    }
  }
  out.finish();
}

} // namespace tamp
