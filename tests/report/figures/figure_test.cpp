// Scripts and data blocks: escapes, names, digits.
#include "report/figures/figure.h"
#include "report/figures/style.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <set>

using namespace tamp;

TEST_CASE("Names of files are plain, and labels mean nothing to gnuplot") {
  CHECK(slug("D&R, radius kept") == "d_r_radius_kept");
  CHECK(slug("φ = 0.5/") == "0_5");
  CHECK(gnuplot_text("it's {x}_^") == "it’s \\{x\\}\\_\\^");
}

TEST_CASE("Data blocks keep all digits and are parted as gnuplot wants") {
  DataBlocks data;
  const std::vector<std::vector<double>> rows = {{0.1, 1.0 / 3}, {1e-20, std::nan("")}};
  CHECK(data.add("one", std::array<std::string_view, 2>{"a", "b"}, rows) == 0);
  CHECK(data.add("two\nlines", std::array<std::string_view, 2>{"a", "b"}, {}) == 1);
  CHECK(data.text() == "# index 0: one\n# a b\n0.1 0.3333333333333333\n1e-20 NaN\n\n\n# index 1: two lines\n# a b\n");
}

TEST_CASE("Each method has a colour and a point of its own, and the style script defines them") {
  std::set<std::string> looks;
  for (const MethodInfo& method : methods())
    looks.insert(series_look(method.name, 0));
  CHECK(looks.size() == methods().size());
  for (const MethodInfo& method : methods()) {
    std::set<std::string> points;
    for (std::size_t variant = 0; variant < kVariants; ++variant) {
      const std::string look = series_look(method.name, variant);
      points.insert(look.substr(0, look.find(" dt "))); // a scatter has no dashes
    }
    CHECK(points.size() == kVariants);
  }
  CHECK(solid(" lc rgb c pt 1 dt 3 lw 1.5") == " lc rgb c pt 1 dt 1 lw 1.5");
  CHECK(style_script().find("c_dem_isostatic = '#009E73'") != std::string::npos);
  CHECK(palette_hex(0) == "'#440154'");
}
