// Draws figures with the real gnuplot, in a folder of its own that vanishes afterwards.
#pragma once

#include "report/figures/figure.h"

#include <map>
#include <span>
#include <string>

namespace tamp {

/// The three pictures of a figure, as bytes; the same bytes for the same figure.
struct Drawing {
  std::string svg;
  std::string pdf; ///< without the date of its making
  std::string png;
};

/// Drawings by the figure's name; without those that failed. `why` tells what gnuplot said of them, or that it could
/// not be started; empty if all is well.
struct Drawings {
  std::map<std::string, Drawing> by_name;
  std::string why;
};

/// `program`: gnuplot 5.4 or later, looked up in PATH. Throws Error if the temporary folder cannot be written.
Drawings draw(std::span<const Figure> figures, const std::string& program);

} // namespace tamp
