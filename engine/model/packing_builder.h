// Collects the spheres that a foreign file tells of into a Packing, and refuses what no packing can be.
#pragma once

#include "engine/model/packing.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tamp {

struct Interval {
  double low = 0;
  double high = 0;
};

/// What is known of the space around the spheres; a file, or the user, may leave any of it unsaid.
struct Surroundings {
  std::optional<LengthUnit> unit;
  std::optional<int> dimension;
  std::array<std::optional<Interval>, 3> box; ///< of each axis, in the coordinates of the file
  std::array<std::optional<Boundary>, 3> boundary;
};

/// A packing as a file told it. What `said` leaves open was found instead: the unit is µm; two dimensions if there is
/// no third coordinate but 0; an edge of the box goes from the lowest to the highest point of the spheres; without a
/// word on its sides an axis is walled if the file tells its edge, and open if that was found.
struct ReadPacking {
  Packing packing;
  Surroundings said;                ///< by the file and the user
  std::array<double, 3> origin{};   ///< lower corner of the box in the file, which becomes 0 in the packing
  std::int64_t step = 0;            ///< time step, where the file has one
  std::vector<std::int64_t> ids;    ///< the file's numbers of the spheres, ascending; from 1 where it has none
  std::vector<std::string> columns; ///< of a sphere, as the file names them
};

/// Longest extent of spheres and box in units of the smallest radius. Coordinates carry a rounding of 1e-16 of the
/// extent, so beyond this it is no longer known to a relative 1e-6 where the surface of that sphere is.
inline constexpr double kLongestExtent = 1e10;

/// The spheres of one file. Mistakes are InputErrors "file:line: message".
class PackingBuilder {
public:
  /// `file_size` bounds the number of spheres that can be expected.
  PackingBuilder(std::filesystem::path path, std::uintmax_t file_size)
      : path_(std::move(path)), file_size_(file_size) {}

  /// Makes room for `count` spheres, as far as the file can hold so many.
  void expect(std::int64_t count);

  /// A sphere and its line (0: none). Fails unless the centre is finite and the radius a length above 0. Without a
  /// `number` spheres are numbered from 1.
  void add(std::size_t line, const std::array<double, 3>& centre, double radius,
           std::optional<std::int64_t> number = {});
  [[nodiscard]] std::size_t count() const { return spheres_.size(); }

  /// Spheres in the order of their numbers, as `file` and, where they differ, `stated` by the user describe their
  /// surroundings. Fails for a number that occurs twice, no sphere at all, a centre beyond a wall, a sphere wider than
  /// a period, an impossible box, an extent above kLongestExtent. The builder is empty afterwards.
  ReadPacking finish(const Surroundings& file, const Surroundings& stated);

private:
  struct Sphere {
    std::array<double, 3> centre;
    double radius;
    std::int64_t id;
    std::size_t line;
  };
  void sort();
  void check_extent(const Packing& packing, const std::array<double, 3>& origin) const;
  [[nodiscard]] Interval extent(std::size_t axis) const;
  void check_axis(std::size_t axis, const Interval& edge, Boundary boundary, bool vertical) const;

  std::filesystem::path path_;
  std::uintmax_t file_size_;
  std::vector<Sphere> spheres_;
};

} // namespace tamp
