// Packings as a voxel image: raw bytes and a MetaImage header, for solvers on regular grids.
#include "engine/base/error.h"
#include "engine/base/file_writer.h"
#include "store/formats/makers.h"
#include "store/formats/statements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tamp {

namespace {

constexpr std::int64_t kMostVoxels = 4096; // along an edge

/// The grid of cubic voxels: `n` of them an axis, of one `edge`, the last ones reaching past the box by less than one.
struct Grid {
  std::array<std::int64_t, 3> n{1, 1, 1};
  double edge = 1;
};

Grid grid_of(const Packing& packing, std::int64_t voxels) {
  if (voxels < 1 || voxels > kMostVoxels)
    throw InputError(fmt::format("{} voxels along the longest edge; allowed: from 1 to {}", voxels, kMostVoxels));
  constexpr double kWhole = 1e-9; // of a voxel: an edge this little past a whole number is rounding
  Grid grid;
  grid.edge = *std::max_element(packing.size.begin(), packing.size.end()) / static_cast<double>(voxels);
  for (std::size_t a = 0; a < static_cast<std::size_t>(packing.dimension); ++a)
    grid.n[a] = std::max<std::int64_t>(1, std::llround(std::ceil(packing.size[a] / grid.edge - kWhole)));
  return grid;
}

/// First and last voxel whose centre lies within [low, high].
std::pair<std::int64_t, std::int64_t> covered(double low, double high, double edge) {
  return {std::llround(std::ceil(low / edge - 0.5)), std::llround(std::floor(high / edge - 0.5))};
}

/// Paints one slice at a time; a slice is all the memory that an image takes.
class Painter {
public:
  Painter(const Packing& packing, const Grid& grid)
      : packing_(packing), grid_(grid), slice_(static_cast<std::size_t>(grid.n[0] * grid.n[1])) {}

  void clear() { std::fill(slice_.begin(), slice_.end(), '\0'); }
  [[nodiscard]] std::string_view bytes() const { return {slice_.data(), slice_.size()}; }

  /// The disc in which a sphere at (x, y) cuts the slice.
  void disc(double x, double y, double radius) {
    const auto [first, last] = limited(covered(y - radius, y + radius, grid_.edge), 1);
    for (std::int64_t row = first; row <= last; ++row) {
      const double dy = (static_cast<double>(row) + 0.5) * grid_.edge - y;
      const double half = std::sqrt(std::max(0.0, radius * radius - dy * dy));
      const auto [from, to] = limited(covered(x - half, x + half, grid_.edge), 0);
      for (std::int64_t column = from; column <= to; ++column)
        slice_[static_cast<std::size_t>(wrapped(row, 1) * grid_.n[0] + wrapped(column, 0))] = 1;
    }
  }

private:
  [[nodiscard]] bool periodic(std::size_t axis) const { return packing_.boundary[axis] == Boundary::periodic; }
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> limited(std::pair<std::int64_t, std::int64_t> range,
                                                              std::size_t axis) const {
    if (periodic(axis))
      return range;
    return {std::max<std::int64_t>(range.first, 0), std::min(range.second, grid_.n[axis] - 1)};
  }
  [[nodiscard]] std::int64_t wrapped(std::int64_t i, std::size_t axis) const {
    return ((i % grid_.n[axis]) + grid_.n[axis]) % grid_.n[axis];
  }

  const Packing& packing_;
  const Grid& grid_;
  std::vector<char> slice_;
};

/// A sphere, or its image across a periodic axis z, by the slices that it reaches.
struct Reach {
  std::size_t sphere;
  double z;
  std::int64_t first;
  std::int64_t last;
};

std::vector<Reach> reaches(const Packing& packing, const Grid& grid) {
  std::vector<Reach> all;
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const double r = packing.radii[i];
    double z = packing.centre_in_space(i)[2];
    const bool periodic = packing.boundary[2] == Boundary::periodic;
    if (periodic)
      z -= std::floor(z / packing.size[2]) * packing.size[2];
    for (const int image : {-1, 0, 1}) {
      if (image != 0 && !periodic)
        continue;
      const double at = z + image * packing.size[2];
      const auto [first, last] = covered(at - r, at + r, grid.edge);
      if (last >= 0 && first < grid.n[2] && first <= last)
        all.push_back({i, at, std::max<std::int64_t>(first, 0), std::min(last, grid.n[2] - 1)});
    }
  }
  std::sort(all.begin(), all.end(), [](const Reach& a, const Reach& b) { return a.first < b.first; });
  return all;
}

void write_slices(FileWriter& out, const Packing& packing, const Grid& grid) {
  Painter painter(packing, grid);
  if (packing.dimension == 2) {
    for (std::size_t i = 0; i < packing.count(); ++i)
      painter.disc(packing.positions[2 * i], packing.positions[2 * i + 1], packing.radii[i]);
    out.write(painter.bytes());
    return;
  }
  const std::vector<Reach> all = reaches(packing, grid);
  std::vector<std::size_t> active;
  std::size_t next = 0;
  for (std::int64_t slice = 0; slice < grid.n[2]; ++slice) {
    painter.clear();
    for (; next < all.size() && all[next].first <= slice; ++next)
      active.push_back(next);
    std::erase_if(active, [&](std::size_t i) { return all[i].last < slice; });
    for (const std::size_t i : active) {
      const auto c = packing.centre_in_space(all[i].sphere);
      const double r = packing.radii[all[i].sphere];
      const double dz = (static_cast<double>(slice) + 0.5) * grid.edge - all[i].z;
      if (std::abs(dz) <= r)
        painter.disc(c[0], c[1], std::sqrt(r * r - dz * dz));
    }
    out.write(painter.bytes());
  }
}

} // namespace

void write_meta_image(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options) {
  const Grid grid = grid_of(packing, options.voxels);
  for (std::size_t a = 0; a < static_cast<std::size_t>(packing.dimension); ++a) {
    const double past = static_cast<double>(grid.n[a]) * grid.edge - packing.size[a];
    if (packing.boundary[a] == Boundary::periodic && past > 1e-6 * grid.edge)
      throw InputError(fmt::format("the periodic edge {} is no whole number of voxels of {}; choose another number of "
                                   "voxels along the longest edge",
                                   packing.size[a], grid.edge));
  }
  std::filesystem::path raw = path;
  raw.replace_extension(".raw");
  FileWriter image(raw);
  write_slices(image, packing, grid);
  image.finish();
  const bool flat = packing.dimension == 2;
  FileWriter out(path);
  out.print("ObjectType = Image\nNDims = {}\nComment = 1: solid, 0: pore; unit {}; boundary {}\nBinaryData = True\n"
            "BinaryDataByteOrderMSB = False\nCompressedData = False\n",
            packing.dimension, name_of(packing.unit), boundary_text(packing));
  const auto triple = [&](const char* key, auto x, auto y, auto z) {
    out.print("{} = {} {}{}\n", key, x, y, flat ? std::string() : fmt::format(" {}", z));
  };
  triple("Offset", grid.edge / 2, grid.edge / 2, grid.edge / 2); // of the first voxel's centre
  triple("ElementSpacing", grid.edge, grid.edge, grid.edge);
  triple("DimSize", grid.n[0], grid.n[1], grid.n[2]);
  out.print("ElementType = MET_UCHAR\nElementDataFile = {}\n", raw.filename().string());
  out.finish();
}

} // namespace tamp
