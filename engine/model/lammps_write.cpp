// Packings as text that LAMMPS reads.
#include "engine/base/file_writer.h"
#include "engine/model/lammps_text.h"
#include "engine/model/lammps_words.h"

#include <algorithm>
#include <string>

namespace tamp {

namespace {

constexpr std::array<char, 3> kAxis = {'x', 'y', 'z'};

/// Of an axis; the third of a packing in 2D reaches as far as its largest radius.
Interval edge(const Packing& packing, std::size_t axis) {
  if (axis < static_cast<std::size_t>(packing.dimension))
    return {0, packing.size[axis]};
  const auto largest = std::max_element(packing.radii.begin(), packing.radii.end());
  const double depth = largest == packing.radii.end() ? 1 : *largest;
  return {-depth, depth};
}

/// Of a data file: LAMMPS refuses centres outside of what it reads, but a heap may be higher than its open box.
Interval edge_around(const Packing& packing, std::size_t axis) {
  Interval around = edge(packing, axis);
  if (axis >= static_cast<std::size_t>(packing.dimension) || packing.boundary[axis] != Boundary::open)
    return around;
  const double stated = around.high;
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const double centre = packing.centre_in_space(i)[axis];
    if (centre >= stated)
      around.high = std::max(around.high, centre + packing.radii[i]);
  }
  return around;
}

std::string_view sides(const Packing& packing, std::size_t axis) {
  const auto d = static_cast<std::size_t>(packing.dimension);
  if (axis >= d || packing.boundary[axis] == Boundary::periodic)
    return "pp";
  if (packing.boundary[axis] == Boundary::wall)
    return "ff";
  return axis + 1 == d ? "fs" : "ss";
}

} // namespace

void write_lammps_data(const std::filesystem::path& path, const Packing& packing, double density) {
  FileWriter out(path);
  out.print("LAMMPS data file {}, unit {}, dimension {}, boundary", kByTamp, name_of(packing.unit), packing.dimension);
  for (std::size_t a = 0; a < static_cast<std::size_t>(packing.dimension); ++a)
    out.print(" {}", name_of(packing.boundary[a]));
  out.print("\n\n{} atoms\n1 atom types\n\n", packing.count());
  for (std::size_t a = 0; a < 3; ++a) {
    const Interval around = edge_around(packing, a);
    out.print("{:.17g} {:.17g} {}lo {}hi\n", around.low, around.high, kAxis[a], kAxis[a]);
  }
  out.print("\nAtoms # sphere\n\n"); // id type diameter density x y z
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const std::array<double, 3> c = packing.centre_in_space(i);
    out.print("{} 1 {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", i + 1, 2 * packing.radii[i], density, c[0], c[1], c[2]);
  }
  out.finish();
}

void write_lammps_dump(const std::filesystem::path& path, const Packing& packing, std::int64_t step) {
  FileWriter out(path);
  out.print("ITEM: UNITS\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n", lammps_units(packing.unit), step,
            packing.count());
  out.print("ITEM: BOX BOUNDS {} {} {}\n", sides(packing, 0), sides(packing, 1), sides(packing, 2));
  for (std::size_t a = 0; a < 3; ++a)
    out.print("{:.17g} {:.17g}\n", edge(packing, a).low, edge(packing, a).high);
  out.print("ITEM: ATOMS id type x y z radius\n");
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const std::array<double, 3> c = packing.centre_in_space(i);
    out.print("{} 1 {:.17g} {:.17g} {:.17g} {:.17g}\n", i + 1, c[0], c[1], c[2], packing.radii[i]);
  }
  out.finish();
}

} // namespace tamp
