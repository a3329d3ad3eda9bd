// The text formats of LAMMPS: data files (atom_style sphere) and dumps, written and read in full precision.
#pragma once

#include "engine/model/packing_builder.h"

#include <filesystem>
#include <optional>

namespace tamp {

/// Writes a data file for `atom_style sphere`: one atom type, numbers from 1 in the order of the packing, diameters and
/// coordinates with 17 digits, every sphere of the same `density`, the box from 0. An open axis that ends below a
/// centre is stretched to hold the spheres, as LAMMPS reads none outside. A packing in 2D lies at z = 0 in a
/// box as deep as its largest radius to either side. The first line, which LAMMPS passes over, tells what the format
/// cannot: "… unit um, dimension 3, boundary periodic periodic wall". Throws Error if it cannot be written.
void write_lammps_data(const std::filesystem::path& path, const Packing& packing, double density = 1);

/// Writes a dump of one snapshot with the columns id type x y z radius. Sides become p (periodic), f (wall), s (open;
/// below an open vertical axis f, its floor); the unit of length stands as LAMMPS's name of its system of units.
void write_lammps_dump(const std::filesystem::path& path, const Packing& packing, std::int64_t step = 0);

/// Reads a data file of atom_style sphere: write_lammps_data's, or of LAMMPS's write_data. Sections other than Atoms
/// are passed over. Throws InputError "file:line: message" for anything else, skewed boxes, other styles.
ReadPacking read_lammps_data(const std::filesystem::path& path, const Surroundings& stated = {});

/// Which snapshot of a dump, and what becomes of one that was cut off at the end.
struct DumpChoice {
  std::optional<std::int64_t> step = {}; ///< the last of this time step; without: the last of the file
  bool pass_over_cut = false;            ///< a snapshot that is not complete counts as not there; else it is an error
};

/// Reads a text dump with the columns id (or none), radius or diameter, and x, xs, xu or xsu, the same for y and z, in
/// any order among others. One snapshot at a time is in memory. `origin` of the result is the box's lower corner; an
/// open axis whose lower bound LAMMPS shrinks to the centres begins at the lowest point of the spheres instead.
ReadPacking read_lammps_dump(const std::filesystem::path& path, const Surroundings& stated = {},
                             const DumpChoice& choice = {});

} // namespace tamp
