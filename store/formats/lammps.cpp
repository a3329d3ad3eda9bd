// LAMMPS's text formats as rows of the table.
#include "engine/model/lammps_text.h"
#include "store/formats/makers.h"

namespace tamp {

void export_lammps_data(const std::filesystem::path& path, const Packing& packing, const ExportOptions&) {
  write_lammps_data(path, packing);
}

void export_lammps_dump(const std::filesystem::path& path, const Packing& packing, const ExportOptions&) {
  write_lammps_dump(path, packing);
}

ReadPacking import_lammps_data(const std::filesystem::path& path, const Surroundings& stated) {
  return read_lammps_data(path, stated);
}

ReadPacking import_lammps_dump(const std::filesystem::path& path, const Surroundings& stated) {
  return read_lammps_dump(path, stated);
}

} // namespace tamp
