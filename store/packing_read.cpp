// Reads packings from HDF5, trusting nothing about the file.
#include "store/h5.h"
#include "store/packing_file.h"

#include <algorithm>
#include <vector>

namespace tamp {
namespace {

namespace fs = std::filesystem;

class Reader {
public:
  Reader(const H5Session& session, const fs::path& path) : h5_(session) {
    std::error_code error;
    size_ = fs::file_size(path, error);
    if (error)
      h5_.fail(error.message());
    const auto access = h5_.handle(H5Pcreate(H5P_FILE_ACCESS), "setting up");
    // Packings never change once they have their name; locks would only fail on network folders.
    h5_.check(H5Pset_file_locking(access, false, true), "switching off locks");
    // A damaged file can make HDF5 lose track of its own objects; closing must close them too.
    h5_.check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "setting up");
    file_ = h5_.handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), "opening it as HDF5");
    version_ = integer_attribute("/h5md", "version");
    if (version_ != 1)
      h5_.fail("it has H5MD version " + std::to_string(version_) + "; tamp reads version 1");
    if (const int format = integer_attribute("/parameters/tamp", "format"); format != 1)
      h5_.fail("its form is " + std::to_string(format) + "; this tamp reads 1");
  }

  /// All numbers of a dataset, whose shape must have `rank` entries; `shape` receives them.
  std::vector<double> numbers(const char* name, int rank, std::vector<hsize_t>& shape) const {
    const auto set = dataset(name);
    const auto space = h5_.handle(H5Dget_space(set), "reading a shape");
    if (h5_.check(H5Sget_simple_extent_ndims(space), "reading a shape") != rank)
      h5_.fail(std::string(name) + " has the wrong number of dimensions");
    shape.assign(static_cast<std::size_t>(rank), 0);
    h5_.check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "reading a shape");
    const auto type = h5_.handle(H5Dget_type(set), "reading a type");
    if (H5Tget_class(type) != H5T_FLOAT)
      h5_.fail(std::string(name) + " does not hold numbers");
    // A damaged shape must not make us ask for more memory than the file could fill.
    hsize_t count = 1;
    for (const hsize_t length : shape) {
      if (length > size_)
        h5_.fail(std::string(name) + " is larger than the file");
      count *= length;
    }
    if (count > size_ / sizeof(double))
      h5_.fail(std::string(name) + " is larger than the file");
    std::vector<double> values(count);
    if (count > 0)
      h5_.check(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
    return values;
  }

  std::string text(const char* name) const {
    const auto set = dataset(name);
    const auto type = h5_.handle(H5Dget_type(set), "reading a type");
    std::string value(checked_width(type, H5Dget_space(set), 1, name), '\0');
    h5_.check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), name);
    return trimmed(value);
  }

  /// The texts of an attribute, which must have `count`.
  std::vector<std::string> text_attribute(const char* object, const char* name, std::size_t count) const {
    const auto attribute = open_attribute(object, name);
    const auto type = h5_.handle(H5Aget_type(attribute), "reading a type");
    const std::size_t width = checked_width(type, H5Aget_space(attribute), count, name);
    std::string cells(width * count, '\0');
    h5_.check(H5Aread(attribute, type, cells.data()), name);
    std::vector<std::string> values;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(trimmed(cells.substr(i * width, width)));
    return values;
  }

  /// The first number of an integer attribute of one or two numbers.
  int integer_attribute(const char* object, const char* name) const {
    const auto attribute = open_attribute(object, name);
    const auto space = h5_.handle(H5Aget_space(attribute), "reading a shape");
    const auto type = h5_.handle(H5Aget_type(attribute), "reading a type");
    const auto points = h5_.check(H5Sget_simple_extent_npoints(space), "reading a shape");
    if (H5Tget_class(type) != H5T_INTEGER || points < 1 || points > 2)
      h5_.fail("the attribute " + std::string(name) + " of " + object + " is not an integer");
    int values[2] = {};
    h5_.check(H5Aread(attribute, H5T_NATIVE_INT, values), name);
    return values[0];
  }

  std::string unit(const char* name) const { return text_attribute(name, "unit", 1).front(); }

private:
  static std::string trimmed(std::string value) {
    value.resize(std::min(value.size(), value.find_last_not_of('\0') + 1));
    return value;
  }

  H5Handle dataset(const char* name) const {
    require(name);
    return h5_.handle(H5Dopen2(file_, name, H5P_DEFAULT), name);
  }

  H5Handle open_attribute(const char* object, const char* name) const {
    require(object);
    if (H5Aexists_by_name(file_, object, name, H5P_DEFAULT) <= 0)
      h5_.fail(std::string(object) + " lacks the attribute " + name + "; it is not a packing of tamp");
    return h5_.handle(H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT), name);
  }

  /// Fails with a plain message if an object is missing; HDF5 asks for the groups above it one by one.
  void require(const std::string& name) const {
    for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
      if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
        h5_.fail("it lacks " + name.substr(0, end) + "; it is not a packing of tamp");
      if (end == std::string::npos)
        return;
    }
  }

  std::size_t checked_width(hid_t type, hid_t space_id, std::size_t count, const char* name) const {
    const auto space = h5_.handle(space_id, "reading a shape");
    const auto points = h5_.check(H5Sget_simple_extent_npoints(space), "reading a shape");
    const std::size_t width = H5Tget_size(type);
    const bool is_text = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    if (!is_text || static_cast<std::size_t>(points) != count || width == 0 || width > size_)
      h5_.fail(std::string(name) + " is not " + std::to_string(count) + " text(s) of fixed length");
    return width;
  }

  const H5Session& h5_;
  H5Handle file_;
  std::uintmax_t size_ = 0;
  int version_ = 0;
};

} // namespace

Packing read_packing(const fs::path& path) {
  const H5Session session("read the packing", path);
  const Reader in(session, path);
  constexpr const char* edges = "/particles/powder/box/edges";
  Packing packing;
  packing.dimension = in.integer_attribute("/particles/powder/box", "dimension");
  if (packing.dimension != 2 && packing.dimension != 3)
    session.fail("it has " + std::to_string(packing.dimension) + " dimensions; allowed: 2 or 3");
  const auto d = static_cast<std::size_t>(packing.dimension);

  std::vector<hsize_t> shape;
  const std::vector<double> size = in.numbers(edges, 1, shape);
  if (size.size() != d)
    session.fail("its box has " + std::to_string(size.size()) + " edges");
  std::copy(size.begin(), size.end(), packing.size.begin());
  const std::string unit = in.unit(edges);
  const auto known_unit = enum_of<LengthUnit>(unit);
  if (!known_unit)
    session.fail("its unit of length is \"" + unit + "\"");
  packing.unit = *known_unit;
  const auto boundary = in.text_attribute("/parameters/tamp", "boundary", d);
  for (std::size_t axis = 0; axis < d; ++axis) {
    const auto known = enum_of<Boundary>(boundary[axis]);
    if (!known)
      session.fail("a side of its box is \"" + boundary[axis] + "\"");
    packing.boundary[axis] = *known;
  }

  packing.radii = in.numbers("/particles/powder/radius", 1, shape);
  packing.positions = in.numbers("/particles/powder/position", 2, shape);
  if (shape[0] != packing.count() || shape[1] != d)
    session.fail("it has " + std::to_string(shape[0]) + " centres of " + std::to_string(shape[1]) +
                 " coordinates for " + std::to_string(packing.count()) + " radii");
  for (const char* name : {"/particles/powder/radius", "/particles/powder/position"}) {
    if (in.unit(name) != unit)
      session.fail(std::string(name) + " has another unit than the box");
  }
  return packing;
}

PackingLabel read_packing_label(const fs::path& path) {
  const H5Session session("read the packing", path);
  const Reader in(session, path);
  return {in.text_attribute("/parameters/tamp", "key", 1).front(), in.text("/parameters/tamp/canonical"),
          in.text_attribute("/parameters/tamp", "method", 1).front(),
          in.text_attribute("/h5md/creator", "version", 1).front()};
}

} // namespace tamp
