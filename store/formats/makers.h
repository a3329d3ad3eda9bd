// The functions behind the table of formats, one file each; what each form looks like stands at its declaration.
#pragma once

#include "store/formats/format.h"

namespace tamp {

/// One sphere a line: "x (um),y (um),z (um),r (um)", below comment lines that tell the surroundings (statements.h).
/// Read: any order of columns, radius or diameter, id or none, further columns, comma, semicolon or tab.
void write_csv(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
ReadPacking read_csv(const std::filesystem::path& path, const Surroundings& stated);

/// Extended XYZ: count, then Lattice="…" Origin="…" pbc="T T F" Properties=species:S:1:pos:R:3:radius:R:1 and our keys
/// unit, dimension, boundary, then a sphere a line. Read: the last frame; radius or diameter must be a property.
void write_xyz(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
ReadPacking read_xyz(const std::filesystem::path& path, const Surroundings& stated);

/// Yade's text: "#format x_y_z_r", comment lines that tell the surroundings, then x, y, z, r with tabs between.
void write_yade(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
ReadPacking read_yade(const std::filesystem::path& path, const Surroundings& stated);

/// MercuryDPM's .data: N, time and the box, then 14 (2D: 8) columns a sphere, velocities and angles 0. Has no unit and
/// no sides. Read: the last snapshot.
void write_mercury(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
ReadPacking read_mercury(const std::filesystem::path& path, const Surroundings& stated);

/// VTK PolyData in XML, arrays of 8 bytes appended raw: Points; radius, id and the fields of the options as point
/// data; unit, boundary and box as field data. Read: Float32 or Float64, appended raw or in base64, one piece.
void write_vtp(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
ReadPacking read_vtp(const std::filesystem::path& path, const Surroundings& stated);

/// PATH.mhd and PATH.raw: a byte a voxel, 1 where its centre lies in a sphere, x fastest; in 2D one slice. Throws
/// InputError where a periodic edge is no whole number of voxels.
void write_meta_image(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);

/// Binary STL in single precision. Spheres are written whole, those too that reach through a face of the box. Throws
/// InputError for 2D and for more than 2e7 triangles.
void write_stl(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);

/// See engine/model/lammps_text.h; the last snapshot of a dump.
void export_lammps_data(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
ReadPacking import_lammps_data(const std::filesystem::path& path, const Surroundings& stated);
void export_lammps_dump(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
ReadPacking import_lammps_dump(const std::filesystem::path& path, const Surroundings& stated);

/// See store/packing_file.h; without the key of a job.
void export_hdf5(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options);
ReadPacking import_hdf5(const std::filesystem::path& path, const Surroundings& stated);

} // namespace tamp
