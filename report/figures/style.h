// How all figures look: one colour and one point for each method, a palette for sizes, fonts and sizes for print.
#pragma once

#include "engine/model/method.h"

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace tamp {

/// The script that every figure's script loads; edit it to change them all.
inline constexpr std::string_view kStyleFile = "tamp_style.gp";
std::string style_script();

/// Series of one method in one figure with points that differ.
inline constexpr std::size_t kVariants = 7;
/// The look of a series in plot commands, " lc … pt … dt …". Methods differ by colour and point; several series of one
/// method in one figure (variant 0, 1, …) by point and dashes.
std::string series_look(MethodName method, std::size_t variant);
/// The same without dashes, for the bars of errors.
std::string solid(std::string look);
/// The colour alone, " lc rgb …", for lines and boxes.
std::string method_colour(MethodName method);
/// The same for what gnuplot does not draw: "#0072B2".
std::string_view method_hex(MethodName method);
/// The look of the paper's tools, which are grey and hollow: "D&R", "D&R-ME", "LAMMPS…", "dp3D…".
std::string paper_look(std::string_view tool);

/// Colour of a share from 0 to 1 of the palette (viridis, readable by all eyes and in grey), red, green, blue from 0
/// to 1. `palette` of the style script is the same.
std::array<double, 3> palette_colour(double share);
/// The same as gnuplot's 'rgb' text, "'#440154'".
std::string palette_hex(double share);

} // namespace tamp
