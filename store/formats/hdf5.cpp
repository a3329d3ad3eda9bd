// Our own HDF5 packings as a row of the table.
#include "engine/base/error.h"
#include "store/formats/makers.h"
#include "store/packing_file.h"

namespace tamp {

void export_hdf5(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options) {
  write_packing(path, packing, {"", "", "", options.creator_version});
}

ReadPacking import_hdf5(const std::filesystem::path& path, const Surroundings& stated) {
  Packing stored;
  try {
    stored = read_packing(path);
  } catch (const Error& e) { // whoever names a file to be read states that it is one
    throw InputError(e.what());
  }
  Surroundings said;
  said.unit = stored.unit;
  said.dimension = stored.dimension;
  for (std::size_t a = 0; a < static_cast<std::size_t>(stored.dimension); ++a) {
    said.box[a] = {0, stored.size[a]};
    said.boundary[a] = stored.boundary[a];
  }
  PackingBuilder spheres(path, std::filesystem::file_size(path));
  spheres.expect(static_cast<std::int64_t>(stored.count()));
  for (std::size_t i = 0; i < stored.count(); ++i)
    spheres.add(0, stored.centre_in_space(i), stored.radii[i]);
  return spheres.finish(said, stated);
}

} // namespace tamp
