// Writes packings as HDF5.
#include "engine/base/files.h"
#include "store/h5.h"
#include "store/packing_file.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace tamp {
namespace {

namespace fs = std::filesystem;

/// Writes into one open file. No object carries a time stamp and every layout is fixed, so bytes depend on content.
class Writer {
public:
  Writer(const H5Session& session, const fs::path& path) : h5_(session) {
    const auto access = h5_.handle(H5Pcreate(H5P_FILE_ACCESS), "setting up");
    h5_.check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "choosing the format");
    h5_.check(H5Pset_file_locking(access, false, true), "switching off locks"); // the name is ours alone
    const auto creation = h5_.handle(H5Pcreate(H5P_FILE_CREATE), "setting up");
    h5_.check(H5Pset_obj_track_times(creation, false), "switching off time stamps");
    file_ = h5_.handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), "creating the file");
  }

  H5Handle group(hid_t parent, const char* name) const {
    const auto creation = h5_.handle(H5Pcreate(H5P_GROUP_CREATE), "setting up");
    h5_.check(H5Pset_obj_track_times(creation, false), "switching off time stamps");
    return h5_.handle(H5Gcreate2(parent, name, H5P_DEFAULT, creation, H5P_DEFAULT), "creating a group");
  }

  void numbers(hid_t parent, const char* name, const double* values, const std::vector<hsize_t>& shape,
               std::string_view unit) const {
    const auto set = dataset(parent, name, H5T_IEEE_F64LE, space(shape));
    if (std::find(shape.begin(), shape.end(), 0U) == shape.end())
      h5_.check(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "writing numbers");
    text_attribute(set, "unit", unit);
  }

  /// A text too long for an attribute (64 KiB at most) needs a dataset.
  void text(hid_t parent, const char* name, std::string_view value) const {
    const auto type = text_type(value.size());
    const auto set = dataset(parent, name, type, scalar());
    const std::string padded = value.empty() ? std::string(1, '\0') : std::string(value);
    h5_.check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()), "writing a text");
  }

  void text_attribute(hid_t owner, const char* name, std::string_view value) const {
    const auto type = text_type(value.size());
    const std::string padded = value.empty() ? std::string(1, '\0') : std::string(value);
    attribute(owner, name, type, type, scalar(), padded.data());
  }

  void text_list_attribute(hid_t owner, const char* name, const std::vector<std::string_view>& values) const {
    std::size_t width = 1;
    for (const auto value : values)
      width = std::max(width, value.size());
    std::string cells(width * values.size(), '\0');
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i].copy(cells.data() + i * width, width);
    const auto type = text_type(width);
    attribute(owner, name, type, type, space({values.size()}), cells.data());
  }

  void integer_attribute(hid_t owner, const char* name, int value) const {
    attribute(owner, name, H5T_STD_I32LE, H5T_NATIVE_INT, scalar(), &value);
  }

  void version_attribute(hid_t owner, std::array<int, 2> version) const {
    attribute(owner, "version", H5T_STD_I32LE, H5T_NATIVE_INT, space({version.size()}), version.data());
  }

  [[nodiscard]] hid_t file() const { return file_; }
  void close() { h5_.check(file_.close(), "closing the file"); }

private:
  H5Handle scalar() const { return h5_.handle(H5Screate(H5S_SCALAR), "setting up"); }

  H5Handle space(const std::vector<hsize_t>& shape) const {
    return h5_.handle(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), "setting up");
  }

  /// UTF-8 of fixed length; a text of variable length would lie in a heap.
  H5Handle text_type(std::size_t size) const {
    auto type = h5_.handle(H5Tcopy(H5T_C_S1), "setting up");
    h5_.check(H5Tset_size(type, std::max<std::size_t>(size, 1)), "setting up");
    h5_.check(H5Tset_strpad(type, H5T_STR_NULLPAD), "setting up");
    h5_.check(H5Tset_cset(type, H5T_CSET_UTF8), "setting up");
    return type;
  }

  H5Handle dataset(hid_t parent, const char* name, hid_t type, const H5Handle& shape) const {
    const auto creation = h5_.handle(H5Pcreate(H5P_DATASET_CREATE), "setting up");
    h5_.check(H5Pset_obj_track_times(creation, false), "switching off time stamps");
    h5_.check(H5Pset_layout(creation, H5D_CONTIGUOUS), "choosing the layout");
    h5_.check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY), "choosing the layout");
    h5_.check(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), "choosing the layout");
    return h5_.handle(H5Dcreate2(parent, name, type, shape, H5P_DEFAULT, creation, H5P_DEFAULT), "creating a dataset");
  }

  void attribute(hid_t owner, const char* name, hid_t stored, hid_t given, const H5Handle& shape,
                 const void* value) const {
    const auto made =
        h5_.handle(H5Acreate2(owner, name, stored, shape, H5P_DEFAULT, H5P_DEFAULT), "adding an attribute");
    h5_.check(H5Awrite(made, given, value), "writing an attribute");
  }

  const H5Session& h5_;
  H5Handle file_;
};

void write_header(const Writer& out, const PackingLabel& label) {
  const auto h5md = out.group(out.file(), "h5md");
  out.version_attribute(h5md, {1, 1});
  out.text_attribute(out.group(h5md, "author"), "name", "not stated"); // H5MD asks for one; a name is not content
  const auto creator = out.group(h5md, "creator");
  out.text_attribute(creator, "name", "tamp");
  out.text_attribute(creator, "version", label.creator_version);
  const auto modules = out.group(h5md, "modules");
  out.version_attribute(out.group(modules, "units"), {1, 0});
}

void write_particles(const Writer& out, const Packing& packing) {
  const auto d = static_cast<std::size_t>(packing.dimension);
  const std::string_view unit = name_of(packing.unit);
  const auto particles = out.group(out.file(), "particles");
  const auto powder = out.group(particles, "powder");
  const auto box = out.group(powder, "box");
  out.integer_attribute(box, "dimension", packing.dimension);
  std::vector<std::string_view> boundary;
  for (std::size_t axis = 0; axis < d; ++axis)
    boundary.emplace_back(packing.boundary[axis] == Boundary::periodic ? "periodic" : "none");
  out.text_list_attribute(box, "boundary", boundary);
  out.numbers(box, "edges", packing.size.data(), {d}, unit);
  out.numbers(powder, "position", packing.positions.data(), {packing.count(), d}, unit);
  out.numbers(powder, "radius", packing.radii.data(), {packing.count()}, unit);
}

void write_parameters(const Writer& out, const Packing& packing, const PackingLabel& label) {
  const auto parameters = out.group(out.file(), "parameters");
  const auto ours = out.group(parameters, "tamp");
  out.integer_attribute(ours, "format", 1);
  out.text_attribute(ours, "key", label.key);
  out.text_attribute(ours, "method", label.method);
  std::vector<std::string_view> boundary;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(packing.dimension); ++axis)
    boundary.push_back(name_of(packing.boundary[axis]));
  out.text_list_attribute(ours, "boundary", boundary);
  out.text(ours, "canonical", label.canonical);
}

/// Writes all of `temporary`, which is to become `path`.
void write_whole(const fs::path& temporary, const fs::path& path, const Packing& packing, const PackingLabel& label) {
  const H5Session session("write the packing", path);
  if (packing.dimension != 2 && packing.dimension != 3)
    session.fail("it has " + std::to_string(packing.dimension) + " dimensions; allowed: 2 or 3");
  if (packing.positions.size() != packing.count() * static_cast<std::size_t>(packing.dimension)) {
    session.fail("it has " + std::to_string(packing.positions.size()) + " coordinates for " +
                 std::to_string(packing.count()) + " spheres");
  }
  Writer out(session, temporary);
  write_header(out, label);
  write_particles(out, packing);
  write_parameters(out, packing, label);
  out.close();
}

} // namespace

void write_packing(const fs::path& path, const Packing& packing, const PackingLabel& label) {
  const fs::path temporary = temporary_name(path);
  try {
    write_whole(temporary, path, packing, label);
    publish(temporary, path);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

} // namespace tamp
