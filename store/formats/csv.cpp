// Packings as CSV.
#include "store/formats/makers.h"
#include "store/formats/statements.h"

#include <algorithm>
#include <cctype>

namespace tamp {

namespace {

constexpr std::string_view kHeaderHelp =
    "the first line must name the columns x, y, z (none in 2D) and r, radius, d or "
    "diameter, as \"x (um),y (um),z (um),r (um)\"";

struct Columns {
  std::array<std::optional<std::size_t>, 3> place;
  std::optional<std::size_t> size;
  double to_radius = 1;
  std::optional<std::size_t> id;
  std::size_t count = 0;
  std::vector<std::string> names;
};

std::string plain_name(std::string_view cell) {
  std::string name;
  for (const char c : cell) {
    if (c != '"' && c != '\'')
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

/// "um" of "x (um)" or "x [um]"; the name loses it.
std::string cut_unit(std::string& name) {
  const std::size_t open = name.find_first_of("([");
  if (open == name.npos)
    return {};
  std::string unit = name.substr(open + 1, name.find_first_of(")]", open) - open - 1);
  name = trimmed(std::string_view(name).substr(0, open));
  return unit == "µm" || unit == "μm" ? "um" : unit; // both signs of micro
}

Columns read_header(LineReader& in, char separator, Surroundings& said) {
  Columns columns;
  std::optional<LengthUnit> unit;
  const std::vector<std::string_view> cells = in.fields(separator);
  columns.count = cells.size();
  for (std::size_t at = 0; at < cells.size(); ++at) {
    std::string name = plain_name(cells[at]);
    const std::string stated = cut_unit(name);
    columns.names.push_back(name);
    const std::size_t axis = name.size() == 1 ? static_cast<std::size_t>(name[0] - 'x') : 3;
    const bool radius = name == "r" || name == "radius";
    const bool diameter = name == "d" || name == "diameter";
    if (name == "id")
      columns.id = at;
    if (axis >= 3 && !radius && !diameter)
      continue;
    std::optional<std::size_t>& target = axis < 3 ? columns.place[axis] : columns.size;
    if (target)
      in.fail(fmt::format("two columns tell the same: \"{}\" and \"{}\"", columns.names[*target], name));
    target = at;
    columns.to_radius = diameter ? 0.5 : columns.to_radius;
    if (stated.empty())
      continue;
    const auto known = enum_of<LengthUnit>(stated);
    if (!known)
      in.fail(fmt::format("unknown unit \"{}\"; allowed: nm, um, mm, m", stated));
    if (unit && unit != known)
      in.fail("columns in different units");
    unit = known;
  }
  if (!columns.place[0] || !columns.place[1] || !columns.size)
    in.fail(kHeaderHelp);
  if (!columns.place[2])
    said.dimension = 2;
  if (unit)
    said.unit = unit;
  return columns;
}

} // namespace

void write_csv(const std::filesystem::path& path, const Packing& packing, const ExportOptions&) {
  FileWriter out(path);
  write_statements(out, packing);
  const std::string_view unit = name_of(packing.unit);
  out.print("x ({0}),y ({0}),{1}r ({0})\n", unit, packing.dimension == 3 ? fmt::format("z ({}),", unit) : "");
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const auto c = packing.centre_in_space(i);
    if (packing.dimension == 3)
      out.print("{},{},{},{}\n", c[0], c[1], c[2], packing.radii[i]);
    else
      out.print("{},{},{}\n", c[0], c[1], packing.radii[i]);
  }
  out.finish();
}

ReadPacking read_csv(const std::filesystem::path& path, const Surroundings& stated) {
  LineReader in(path);
  PackingBuilder spheres(path, in.file_size());
  Statements found;
  std::optional<Columns> columns;
  char separator = ',';
  while (in.next()) {
    if (trimmed(in.line()).empty())
      continue;
    if (in.line().starts_with('#')) {
      read_statement(in, found);
      continue;
    }
    if (!columns) {
      if (const std::size_t at = in.line().find_first_of(";\t,"); at != std::string_view::npos)
        separator = in.line()[at];
      columns = read_header(in, separator, found.said);
      spheres.expect(found.count.value_or(0));
      continue;
    }
    const std::vector<std::string_view>& f = in.fields(separator);
    if (f.size() != columns->count)
      in.fail(fmt::format("{} columns; the header has {}", f.size(), columns->count));
    std::array<double, 3> centre{};
    for (std::size_t a = 0; a < 3; ++a) {
      if (columns->place[a])
        centre[a] = in.to_number(f[*columns->place[a]], columns->names[*columns->place[a]]);
    }
    std::optional<std::int64_t> id;
    if (columns->id)
      id = in.to_integer(f[*columns->id], "the id");
    spheres.add(in.number(), centre, columns->to_radius * in.to_number(f[*columns->size], "the radius"), id);
  }
  if (!columns)
    in.fail(kHeaderHelp);
  check_count(in, found, spheres.count());
  ReadPacking read = spheres.finish(found.said, stated);
  read.columns = columns->names;
  return read;
}

} // namespace tamp
