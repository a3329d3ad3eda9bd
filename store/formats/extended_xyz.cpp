// Packings as extended XYZ, the form that OVITO and ASE share.
#include "engine/base/error.h"
#include "store/formats/makers.h"
#include "store/formats/statements.h"

#include <algorithm>
#include <map>

namespace tamp {

namespace {

/// The pairs key=value of the comment line; values may stand in quotes.
std::map<std::string, std::string, std::less<>> read_keys(std::string_view line) {
  std::map<std::string, std::string, std::less<>> keys;
  while (!(line = trimmed(line)).empty()) {
    const std::size_t end = std::min(line.find_first_of("= \t"), line.size());
    const std::string key(line.substr(0, end));
    line.remove_prefix(end);
    std::string value = "T"; // a bare word is a statement that holds
    if (line.starts_with('=')) {
      line.remove_prefix(1);
      const bool quoted = line.starts_with('"');
      line.remove_prefix(quoted ? 1 : 0);
      const std::size_t stop = std::min(quoted ? line.find('"') : line.find_first_of(" \t"), line.size());
      value = line.substr(0, stop);
      line.remove_prefix(std::min(stop + (quoted ? 1 : 0), line.size()));
    }
    keys[key] = value;
  }
  return keys;
}

template <std::size_t N>
std::array<double, N> read_numbers(const LineReader& in, std::string_view text, std::string_view what) {
  std::array<double, N> numbers{};
  for (double& number : numbers) {
    text = trimmed(text);
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    number = in.to_number(text.substr(0, end), what);
    text.remove_prefix(end);
  }
  if (!trimmed(text).empty())
    in.fail(fmt::format("{} has more than {} numbers", what, N));
  return numbers;
}

struct Columns {
  std::size_t count = 0;
  std::optional<std::size_t> place;
  std::optional<std::size_t> size;
  double to_radius = 1;
  std::optional<std::size_t> id;
  std::vector<std::string> names;
};

/// Properties=name:type:columns:…
Columns read_properties(const LineReader& in, std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t last = std::min(text.find(':', first), text.size());
    parts.push_back(text.substr(first, last - first));
    first = last + 1;
  }
  if (parts.size() % 3 != 0)
    in.fail("Properties must be name:type:columns, again and again");
  Columns columns;
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    const std::string_view name = parts[i];
    const std::int64_t width = in.to_integer(parts[i + 2], "a number of columns");
    if (width < 1 || width > 1000)
      in.fail(fmt::format("a property of {} columns", width));
    if (name == "pos" && width == 3)
      columns.place = columns.count;
    const bool radius = name == "radius" || name == "Radius" || name == "radii";
    if ((radius || name == "diameter") && width == 1) {
      columns.size = columns.count;
      columns.to_radius = radius ? 1 : 0.5;
    }
    if (name == "id" && width == 1)
      columns.id = columns.count;
    columns.names.emplace_back(name);
    columns.count += static_cast<std::size_t>(width);
  }
  if (!columns.place)
    in.fail("no property pos:R:3");
  if (!columns.size)
    in.fail("no property radius:R:1 or diameter:R:1, so the spheres have no sizes");
  return columns;
}

Surroundings read_surroundings(const LineReader& in, const std::map<std::string, std::string, std::less<>>& keys) {
  Surroundings said;
  std::array<double, 3> origin{};
  if (const auto at = keys.find("Origin"); at != keys.end())
    origin = read_numbers<3>(in, at->second, "Origin");
  if (const auto at = keys.find("Lattice"); at != keys.end()) {
    const auto edges = read_numbers<9>(in, at->second, "Lattice");
    for (std::size_t i = 0; i < 9; ++i) {
      if (i % 4 != 0 && edges[i] != 0)
        in.fail("the box is skewed; only boxes of right angles can be read");
    }
    for (std::size_t a = 0; a < 3; ++a)
      said.box[a] = {origin[a], origin[a] + edges[4 * a]};
  }
  if (const auto at = keys.find("pbc"); at != keys.end()) {
    std::size_t axis = 0;
    for (const char c : at->second) {
      if (axis < 3 && c == 'T')
        said.boundary[axis] = Boundary::periodic;
      axis += c == 'T' || c == 'F' ? 1 : 0;
    }
  }
  if (const auto at = keys.find("unit"); at != keys.end())
    said.unit = enum_of<LengthUnit>(at->second);
  if (const auto at = keys.find("dimension"); at != keys.end())
    said.dimension = at->second == "2" ? 2 : 3;
  if (const auto at = keys.find("boundary"); at != keys.end())
    said.boundary = read_boundary(at->second);
  return said;
}

/// The count and the comment line of a frame; false at the end of the file.
bool read_head(LineReader& in, std::int64_t& count, std::string& comment) {
  do {
    if (!in.next())
      return false;
  } while (trimmed(in.line()).empty());
  count = in.to_integer(trimmed(in.line()), "the number of spheres");
  if (count < 0)
    in.fail(fmt::format("{} spheres", count));
  in.require("the comment line");
  comment = in.line();
  return true;
}

/// The number of frames; the last may be cut off.
std::size_t count_frames(const std::filesystem::path& path) {
  LineReader in(path);
  std::size_t frames = 0;
  std::int64_t count = 0;
  std::string comment;
  for (; read_head(in, count, comment); ++frames) {
    for (std::int64_t i = 0; i < count && in.next(); ++i) {
    }
  }
  return frames;
}

} // namespace

void write_xyz(const std::filesystem::path& path, const Packing& packing, const ExportOptions&) {
  FileWriter out(path);
  const bool flat = packing.dimension == 2;
  const double depth = flat && packing.count() > 0 ? *std::max_element(packing.radii.begin(), packing.radii.end()) : 0;
  const auto pbc = [&](std::size_t a) { return packing.boundary[a] == Boundary::periodic && !(flat && a == 2); };
  out.print("{}\n", packing.count());
  out.print("Lattice=\"{} 0 0 0 {} 0 0 0 {}\" Origin=\"0 0 {}\" pbc=\"{} {} {}\" ", packing.size[0], packing.size[1],
            flat ? 2 * depth : packing.size[2], flat ? -depth : 0, pbc(0) ? 'T' : 'F', pbc(1) ? 'T' : 'F',
            pbc(2) ? 'T' : 'F');
  out.print("unit={} dimension={} boundary=\"{}\" Properties=species:S:1:pos:R:3:radius:R:1\n", name_of(packing.unit),
            packing.dimension, boundary_text(packing));
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const auto c = packing.centre_in_space(i);
    out.print("X {} {} {} {}\n", c[0], c[1], c[2], packing.radii[i]); // X: no chemical element
  }
  out.finish();
}

ReadPacking read_xyz(const std::filesystem::path& path, const Surroundings& stated) {
  const std::size_t frames = count_frames(path);
  if (frames == 0)
    fail_in_line(path, 0, "there is no sphere in the file");
  LineReader in(path);
  std::int64_t count = 0;
  std::string comment;
  for (std::size_t frame = 0; read_head(in, count, comment) && frame + 1 < frames; ++frame) {
    for (std::int64_t i = 0; i < count && in.next(); ++i) {
    }
  }
  const auto keys = read_keys(comment);
  const auto properties = keys.find("Properties");
  if (properties == keys.end())
    in.fail("no Properties=… in the comment line: a plain XYZ file has no radii");
  const Columns columns = read_properties(in, properties->second);
  const Surroundings said = read_surroundings(in, keys);
  PackingBuilder spheres(path, in.file_size());
  spheres.expect(count);
  for (std::int64_t i = 0; i < count; ++i) {
    in.require(fmt::format("sphere {} of {}", i + 1, count));
    const std::vector<std::string_view>& f = in.fields();
    if (f.size() != columns.count)
      in.fail(fmt::format("{} columns; Properties tell of {}", f.size(), columns.count));
    std::array<double, 3> centre{};
    for (std::size_t a = 0; a < 3; ++a)
      centre[a] = in.to_number(f[*columns.place + a], "a coordinate");
    std::optional<std::int64_t> id;
    if (columns.id)
      id = in.to_integer(f[*columns.id], "the id");
    spheres.add(in.number(), centre, columns.to_radius * in.to_number(f[*columns.size], "the radius"), id);
  }
  ReadPacking read = spheres.finish(said, stated);
  read.columns = columns.names;
  return read;
}

} // namespace tamp
