// Pictures of packings made of pixels: discs seen from above their plane, spheres shaded and cut open.
#pragma once

#include "engine/model/packing.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tamp {

/// Which colour of the palette a radius has: from `low` to `high`, in logarithms where they are far apart.
struct ColourScale {
  double low;
  double high;
  bool logarithmic;

  [[nodiscard]] double share(double radius) const;
};
/// From the smallest to the largest radius. The packing must not be empty.
ColourScale colour_scale(const Packing& packing);

/// Rows from the top; red, green and blue of each pixel in bytes. `pixel` is its edge in the packing's unit.
struct Picture {
  std::size_t width = 0;
  std::size_t height = 0;
  double pixel = 0;
  std::vector<std::uint8_t> rgb;

  /// As a file in the format PPM (P6), and where its pixels begin.
  [[nodiscard]] std::string ppm() const;
  [[nodiscard]] std::size_t ppm_header() const;
};

/// The packing with its longest side `pixels` pixels long. Spheres are seen in parallel projection from above one edge
/// of the box, whose octant nearest to the eye is cut away: what the cut goes through shows a flat face. What a
/// periodic box has beyond a face stands on the other side too. Throws InputError for an empty packing.
Picture draw_packing(const Packing& packing, const ColourScale& scale, std::size_t pixels);

} // namespace tamp
