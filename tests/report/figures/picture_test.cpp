// Pictures of packings against what can be counted: covered areas, flat cuts, colours, other units and places.
#include "engine/base/error.h"
#include "report/figures/picture.h"
#include "report/figures/style.h"
#include "tests/report/figures/synthetic_figures.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace tamp;
using namespace tamp::test;

namespace {

/// Share of the picture that is not paper.
double covered(const Picture& picture) {
  double ink = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    ink += picture.rgb[i] == 255 && picture.rgb[i + 1] == 255 && picture.rgb[i + 2] == 255 ? 0 : 1;
  return ink / static_cast<double>(picture.rgb.size() / 3);
}

Packing one_disc(double x, double y, Boundary boundary) {
  Packing packing;
  packing.dimension = 2;
  packing.size = {10, 10, 0};
  packing.boundary = {boundary, boundary, Boundary::wall};
  packing.positions = {x, y};
  packing.radii = {2};
  return packing;
}

Picture drawn(const Packing& packing, std::size_t pixels = 400) {
  return draw_packing(packing, colour_scale(packing), pixels);
}

} // namespace

TEST_CASE("A disc covers its area, wherever a periodic box cuts it") {
  const double area = 3.14159265 * 4 / 100;
  CHECK(covered(drawn(one_disc(5, 5, Boundary::wall))) == Approx(area).epsilon(0.02));
  CHECK(covered(drawn(one_disc(0.5, 9.8, Boundary::periodic))) == Approx(area).epsilon(0.02));
  CHECK(covered(drawn(one_disc(0.5, 5, Boundary::wall))) < 0.8 * area); // walls have no other side
}

TEST_CASE("Colours follow the palette, in logarithms where radii are far apart") {
  const ColourScale scale = colour_scale(small_packing(3));
  CHECK(scale.logarithmic);
  CHECK(scale.share(1) == Approx(1));
  CHECK(scale.share(0.5) == Approx(2.0 / 3));
  Packing equal = one_disc(5, 5, Boundary::wall);
  CHECK(colour_scale(equal).share(2) == Approx(0.5));
  const Picture picture = drawn(equal);
  const std::size_t middle = 3 * (200 * picture.width + 200);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(std::abs(picture.rgb[middle + k] - 255 * palette_colour(0.5)[k]) < 1);
}

TEST_CASE("A sphere that fills the box is cut open to its middle by a flat face") {
  Packing packing;
  packing.size = {2, 2, 2};
  packing.positions = {1, 1, 1};
  packing.radii = {1};
  const Picture picture = drawn(packing);
  // Each face of the cut is a quarter of a disc of one colour, seen at the angle of the eye.
  std::map<std::array<std::uint8_t, 3>, double> areas;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    areas[{picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]}] += picture.pixel * picture.pixel;
  const double eye = std::hypot(1.0, 1.3, 0.95);
  for (const double along : {1.0, 1.3, 0.95}) {
    const double expected = 3.14159265 / 4 * along / eye;
    CHECK(std::any_of(areas.begin(), areas.end(),
                      [&](const auto& area) { return std::abs(area.second - expected) < 0.03 * expected; }));
  }
}

TEST_CASE("A picture is the same in every unit of length, and bounded in size") {
  const Packing packing = small_packing(3, Boundary::periodic);
  Packing scaled = packing;
  constexpr double kFactor = 1024; // exact in binary
  for (double& edge : scaled.size)
    edge *= kFactor;
  for (double& x : scaled.positions)
    x *= kFactor;
  for (double& r : scaled.radii)
    r *= kFactor;
  const Picture picture = drawn(packing, 100);
  CHECK(drawn(scaled, 100).rgb == picture.rgb);
  CHECK(std::max(picture.width, picture.height) == 100);
  CHECK(picture.ppm().size() == picture.ppm_header() + 3 * picture.width * picture.height);
  CHECK_THROWS_AS(draw_packing(Packing{}, {1, 2, false}, 10), InputError);
}
