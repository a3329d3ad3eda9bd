// The tables of colours and points, and the style script made from them.
#include "report/figures/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

struct MethodLook {
  MethodName method;
  const char* colour; ///< Okabe and Ito, "Color Universal Design" (2008)
  int point;          ///< of gnuplot, filled; the hollow one is a number less
};
constexpr std::array kLooks = {
    MethodLook{MethodName::drop_and_roll, "#0072B2", 7},     MethodLook{MethodName::drop_and_roll_me, "#E69F00", 5},
    MethodLook{MethodName::dem_gravity, "#D55E00", 9},       MethodLook{MethodName::dem_isostatic, "#009E73", 11},
    MethodLook{MethodName::lattice, "#CC79A7", 13},          MethodLook{MethodName::lammps_gravity, "#56B4E9", 9},
    MethodLook{MethodName::lammps_isostatic, "#F0E442", 11},
};
static_assert(kLooks.size() == EnumNames<MethodName>::value.size());

struct PaperLook {
  std::string_view tool;
  int point;
};
/// Hollow, with the point of our method that does the same.
constexpr std::array kPaperLooks = {PaperLook{"D&R-ME", 4}, PaperLook{"D&R", 6}, PaperLook{"LAMMPS", 8},
                                    PaperLook{"dp3D", 10}};
constexpr const char* kPaperColour = "#777777";

using Colour = std::array<double, 3>;
/// Nine colours of viridis (van der Walt and Smith, 2015), equally spaced.
constexpr std::array kViridis = {
    Colour{0.267004, 0.004874, 0.329415}, Colour{0.282623, 0.140926, 0.457517}, Colour{0.253935, 0.265254, 0.529983},
    Colour{0.206756, 0.371758, 0.553117}, Colour{0.163625, 0.471133, 0.558148}, Colour{0.134692, 0.658636, 0.517649},
    Colour{0.369214, 0.788888, 0.382914}, Colour{0.678489, 0.863742, 0.189503}, Colour{0.993248, 0.906157, 0.143936}};

std::string variable(MethodName method) {
  std::string name(name_of(method));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

constexpr std::string_view kSettings = R"gp(
set encoding utf8
set border 3 lc rgb '#444444'
set tics nomirror out textcolor rgb '#222222'
set grid lc rgb '#dddddd' lw 0.6 dt 1
set key nobox Left reverse samplen 2.2 spacing 1.15
set pointsize 0.9
set bars 0.6
set datafile missing 'NaN'
# Sizes in cm; letters of 9 pt in print. The SVG has 45 pixels per cm, the PNG 120 (305 per inch).
terminal(format, name, w, h) = \
  (format eq 'svg' ? sprintf("set terminal svg size %d,%d dynamic enhanced background rgb 'white' font 'Arial,14' linewidth 1.4", 45 * w, 45 * h) : \
   format eq 'pdf' ? sprintf("set terminal pdfcairo size %gcm,%gcm enhanced font 'Arial,9' fontscale 1 linewidth 1.4", w, h) : \
   sprintf("set terminal pngcairo size %d,%d enhanced font 'Arial,9' fontscale 3.17 linewidth 3.6 pointscale 3", 120 * w, 120 * h)) \
  . sprintf("; set output '%s.%s'", name, format)
)gp";

} // namespace

std::string style_script() {
  std::string out =
      "# The style of all figures: a colour (colour-blind safe, Okabe and Ito) and a point for each method.\n";
  for (const MethodLook& look : kLooks)
    out += fmt::format("c_{0} = '{1}'; p_{0} = {2}\n", variable(look.method), look.colour, look.point);
  out += fmt::format("c_paper = '{}'\n", kPaperColour);
  out += kSettings;
  out += "set palette defined (";
  for (std::size_t i = 0; i < kViridis.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kViridis.size() - 1);
    out += fmt::format("{}{} {}", i == 0 ? "" : ", ", share, palette_hex(share));
  }
  return out + ")\n";
}

std::string series_look(MethodName method, std::size_t variant) {
  const std::string name = variable(method);
  const std::string own = "p_" + name;
  // Filled and hollow as the method has it, then points without an inside, then two that no method has.
  const std::array<std::string, kVariants> points = {own, own + "-1", "1", "2", "3", "15", "14"};
  return fmt::format(" lc rgb c_{} pt {} dt {} lw 1.5", name, points[variant % kVariants], variant % 5 + 1);
}

std::string solid(std::string look) {
  if (const std::size_t at = look.find(" dt "); at != std::string::npos)
    look[at + 4] = '1';
  return look;
}

std::string method_colour(MethodName method) {
  return fmt::format(" lc rgb c_{}", variable(method));
}

std::string_view method_hex(MethodName method) {
  return std::find_if(kLooks.begin(), kLooks.end(), [&](const MethodLook& look) { return look.method == method; })
      ->colour;
}

std::string paper_look(std::string_view tool) {
  int point = 6;
  for (const PaperLook& look : kPaperLooks) {
    if (tool.starts_with(look.tool)) {
      point = tool.ends_with("Lee2018") ? look.point + 1 : look.point; // filled: with adhesion and friction
      break;
    }
  }
  return fmt::format(" lc rgb c_paper pt {} dt 3", point);
}

std::array<double, 3> palette_colour(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(kViridis.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(below);
  Colour colour{};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = (1 - part) * kViridis[below][k] + part * kViridis[below + 1][k];
  return colour;
}

std::string palette_hex(double share) {
  const Colour colour = palette_colour(share);
  const auto byte = [](double value) { return static_cast<int>(std::lround(255 * value)); };
  return fmt::format("'#{:02x}{:02x}{:02x}'", byte(colour[0]), byte(colour[1]), byte(colour[2]));
}

} // namespace tamp
