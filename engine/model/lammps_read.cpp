// Data files and dumps of LAMMPS, line by line.
#include "engine/base/error.h"
#include "engine/base/line_reader.h"
#include "engine/model/lammps_text.h"
#include "engine/model/lammps_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace tamp {

namespace {

constexpr std::array<char, 3> kAxis = {'x', 'y', 'z'};
constexpr std::size_t kAtomColumns = 7; // of atom_style sphere: id type diameter density x y z
constexpr std::size_t kImageColumns = 3;

bool begins_with_letter(std::string_view text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) != 0;
}

std::string_view without_comment(std::string_view line) {
  return trimmed(line.substr(0, line.find('#')));
}

// ---- Data files ----

/// The first line: our own statements, or "… timestep = 100, units = micro" of write_data.
void read_title(LineReader& in, Surroundings& said, std::int64_t& step) {
  const bool ours = in.line().find(kByTamp) != std::string_view::npos;
  const std::vector<std::string_view> parts = in.fields(',');
  for (const std::string_view part : parts) {
    const std::size_t space = std::min(part.find(' '), part.size());
    const std::string_view word = part.substr(0, space);
    std::string_view value = trimmed(part.substr(space));
    if (value.starts_with('='))
      value = trimmed(value.substr(1));
    if (word == "timestep")
      step = in.to_integer(value, "the time step");
    else if (word == "units")
      said.unit = unit_of_lammps(value);
    else if (ours && word == "unit")
      said.unit = enum_of<LengthUnit>(value);
    else if (ours && word == "dimension")
      said.dimension = value == "2" ? 2 : 3;
    for (std::size_t a = 0; ours && word == "boundary" && a < 3; ++a) {
      const std::size_t end = std::min(value.find(' '), value.size());
      said.boundary[a] = enum_of<Boundary>(value.substr(0, end));
      value = trimmed(value.substr(end));
    }
  }
}

/// One line before the first section.
void read_header_line(LineReader& in, Surroundings& said, std::optional<std::int64_t>& atoms) {
  const std::vector<std::string_view>& f = in.fields();
  if (f.size() >= 2 && f[1] == "atoms")
    atoms = in.to_integer(f[0], "the number of atoms");
  for (std::size_t a = 0; a < 3; ++a) {
    if (f.size() >= 4 && f[2] == fmt::format("{}lo", kAxis[a]) && f[3] == fmt::format("{}hi", kAxis[a]))
      said.box[a] = {in.to_number(f[0], "the lower bound"), in.to_number(f[1], "the upper bound")};
  }
  if (f.size() >= 4 && f[3] == "xy") {
    for (std::size_t i = 0; i < 3; ++i) {
      if (in.to_number(f[i], "the tilt") != 0)
        in.fail("the box is skewed; only boxes of right angles can be read");
    }
  }
}

void read_atoms(LineReader& in, std::int64_t atoms, PackingBuilder& spheres) {
  const std::string_view style = trimmed(in.line().substr(std::min(in.line().find('#'), in.line().size())));
  if (!style.empty() && trimmed(style.substr(1)) != "sphere")
    in.fail(fmt::format("atoms of style \"{}\"; only atom_style sphere has radii", trimmed(style.substr(1))));
  spheres.expect(atoms);
  do
    in.require("the atoms");
  while (trimmed(in.line()).empty());
  for (std::int64_t i = 0; i < atoms; ++i) {
    if (i > 0)
      in.require(fmt::format("atom {} of {}", i + 1, atoms));
    const std::vector<std::string_view>& f = in.fields();
    if (f.size() < kAtomColumns ||
        (f.size() > kAtomColumns && f.size() != kAtomColumns + kImageColumns && f[kAtomColumns] != "#"))
      in.fail(fmt::format("{} columns; atom {} of {} of style sphere has id type diameter density x y z", f.size(),
                          i + 1, atoms));
    spheres.add(in.number(), {in.to_number(f[4], "x"), in.to_number(f[5], "y"), in.to_number(f[6], "z")},
                in.to_number(f[2], "the diameter") / 2, in.to_integer(f[0], "the id"));
  }
}

} // namespace

ReadPacking read_lammps_data(const std::filesystem::path& path, const Surroundings& stated) {
  LineReader in(path);
  PackingBuilder spheres(path, in.file_size());
  Surroundings said;
  std::int64_t step = 0;
  in.require("its title");
  read_title(in, said, step);
  std::optional<std::int64_t> atoms;
  bool in_sections = false;
  while (spheres.count() == 0) {
    in.require("the section Atoms");
    const std::string_view line = without_comment(in.line());
    in_sections = in_sections || begins_with_letter(line);
    if (!in_sections && !line.empty())
      read_header_line(in, said, atoms);
    if (line != "Atoms")
      continue;
    if (!atoms || *atoms < 1)
      in.fail("atoms, though the header has no line \"N atoms\" with N above 0");
    read_atoms(in, *atoms, spheres);
  }
  while (in.next()) {
    const std::string_view line = without_comment(in.line());
    if (begins_with_letter(line))
      break; // another section
    if (!line.empty())
      in.fail(fmt::format("more than the {} atoms that the header tells of", *atoms));
  }
  ReadPacking read = spheres.finish(said, stated);
  read.step = step;
  read.columns = {"id", "type", "diameter", "density", "x", "y", "z"};
  return read;
}

// ---- Dumps ----

namespace {

/// What stands above the atoms of a snapshot.
struct Head {
  std::int64_t step = 0;
  std::int64_t atoms = 0;
  Surroundings said;
  std::vector<std::string> columns;
};

constexpr std::string_view kItem = "ITEM: ";

void read_bounds(LineReader& in, Head& head) {
  const std::vector<std::string_view> words = in.fields(); // ITEM: BOX BOUNDS [xy xz yz] pp pp ff
  const std::size_t first = words.size() > 3 && words[3] == "xy" ? 6 : 3;
  const std::vector<std::string> sides(words.begin() + static_cast<std::ptrdiff_t>(std::min(first, words.size())),
                                       words.end());
  for (std::size_t a = 0; a < 3; ++a) {
    in.require("the bounds of the box");
    const std::vector<std::string_view>& f = in.fields();
    if (f.size() < 2)
      in.fail("a bound of the box has two numbers");
    const Interval edge{in.to_number(f[0], "the lower bound"), in.to_number(f[1], "the upper bound")};
    if (f.size() > 2 && in.to_number(f[2], "the tilt") != 0)
      in.fail("the box is skewed; only boxes of right angles can be read");
    const std::string side = a < sides.size() ? sides[a] : "ff";
    head.said.boundary[a] = side == "pp" ? Boundary::periodic : side == "ff" ? Boundary::wall : Boundary::open;
    if (side == "pp" || side.starts_with('f'))
      head.said.box[a] = edge; // a shrunk bound is a centre's place, not a wall's
  }
}

/// Reads up to the line of the columns; false at the end of the file.
bool read_head(LineReader& in, Head& head) {
  head = {};
  while (in.next()) {
    const std::string_view item = in.line();
    if (trimmed(item).empty())
      continue;
    if (!item.starts_with(kItem))
      in.fail("a line \"ITEM: …\" should stand here; this is no text dump, or it has more atoms than it says");
    const std::string_view name = trimmed(item.substr(kItem.size()));
    if (name.starts_with("ATOMS")) {
      const std::vector<std::string_view>& words = in.fields();
      head.columns.assign(words.begin() + 2, words.end());
      return true;
    }
    if (name.starts_with("BOX BOUNDS")) {
      read_bounds(in, head);
      continue;
    }
    const bool step = name == "TIMESTEP";
    const bool atoms = name == "NUMBER OF ATOMS";
    const bool units = name == "UNITS";
    if (!step && !atoms && !units && name != "TIME")
      in.fail(fmt::format("unknown item \"{}\"", name.substr(0, 40)));
    in.require("the value of an item");
    if (step)
      head.step = in.to_integer(trimmed(in.line()), "the time step");
    if (atoms)
      head.atoms = in.to_integer(trimmed(in.line()), "the number of atoms");
    if (units)
      head.said.unit = unit_of_lammps(trimmed(in.line()));
  }
  return false;
}

struct Column {
  std::size_t at = 0;
  bool scaled = false; ///< 0 to 1 from bound to bound
};

/// Where a coordinate stands.
Column coordinate(const LineReader& in, const Head& head, std::size_t axis) {
  for (const auto& [suffix, scaled] : {std::pair("", false), {"u", false}, {"s", true}, {"su", true}}) {
    const auto found = std::find(head.columns.begin(), head.columns.end(), fmt::format("{}{}", kAxis[axis], suffix));
    if (found == head.columns.end())
      continue;
    if (scaled && !head.said.box[axis])
      in.fail(fmt::format("{} counts from bound to bound, but the box has none on this axis", *found));
    return {static_cast<std::size_t>(found - head.columns.begin()), scaled};
  }
  in.fail(fmt::format("no column {0}, {0}u, {0}s or {0}su", kAxis[axis]));
}

ReadPacking read_snapshot(LineReader& in, const Head& head, const Surroundings& stated) {
  const auto column = [&](std::string_view name) { return std::find(head.columns.begin(), head.columns.end(), name); };
  const std::array<Column, 3> place{coordinate(in, head, 0), coordinate(in, head, 1), coordinate(in, head, 2)};
  const auto id = column("id");
  const auto radius = column("radius");
  const auto size = radius != head.columns.end() ? radius : column("diameter");
  if (size == head.columns.end())
    in.fail("no column radius or diameter");
  const auto size_at = static_cast<std::size_t>(size - head.columns.begin());
  const double to_radius = *size == "radius" ? 1 : 0.5;
  PackingBuilder spheres(in.path(), in.file_size());
  spheres.expect(head.atoms);
  for (std::int64_t i = 0; i < head.atoms; ++i) {
    in.require(fmt::format("atom {} of {}", i + 1, head.atoms));
    const std::vector<std::string_view>& f = in.fields();
    if (f.size() != head.columns.size())
      in.fail(fmt::format("{} columns; atom {} of {} has {}", f.size(), i + 1, head.atoms, head.columns.size()));
    std::array<double, 3> centre{};
    for (std::size_t a = 0; a < 3; ++a) {
      centre[a] = in.to_number(f[place[a].at], head.columns[place[a].at]);
      if (place[a].scaled)
        centre[a] = head.said.box[a]->low + centre[a] * (head.said.box[a]->high - head.said.box[a]->low);
    }
    std::optional<std::int64_t> number;
    if (id != head.columns.end())
      number = in.to_integer(f[static_cast<std::size_t>(id - head.columns.begin())], "the id");
    spheres.add(in.number(), centre, to_radius * in.to_number(f[size_at], *size), number);
  }
  ReadPacking read = spheres.finish(head.said, stated);
  read.step = head.step;
  read.columns = head.columns;
  return read;
}

/// Passes over the atoms of a snapshot; false if the file ends before.
bool skip_atoms(LineReader& in, const Head& head) {
  for (std::int64_t i = 0; i < head.atoms; ++i) {
    if (!in.next())
      return false;
  }
  return true;
}

/// Which snapshot of the file, counted from 0, is the chosen one.
std::size_t find_snapshot(const std::filesystem::path& path, const DumpChoice& choice) {
  LineReader in(path);
  std::optional<std::size_t> chosen;
  std::size_t at = 0;
  try {
    for (Head head; read_head(in, head); ++at) {
      const bool whole = skip_atoms(in, head);
      if ((whole || !choice.pass_over_cut) && (!choice.step || *choice.step == head.step))
        chosen = at;
    }
  } catch (const InputError&) { // cut off within a head
    if (!choice.pass_over_cut || !chosen)
      throw;
  }
  if (!chosen)
    fail_in_line(path, 0,
                 choice.step ? fmt::format("no snapshot of step {}", *choice.step) : "no snapshot of a LAMMPS dump");
  return *chosen;
}

} // namespace

ReadPacking read_lammps_dump(const std::filesystem::path& path, const Surroundings& stated, const DumpChoice& choice) {
  const std::size_t chosen = find_snapshot(path, choice);
  LineReader in(path);
  Head head;
  for (std::size_t at = 0; read_head(in, head) && at < chosen; ++at)
    skip_atoms(in, head);
  ReadPacking read = read_snapshot(in, head, stated);
  if (in.next() && !trimmed(in.line()).empty() && !in.line().starts_with(kItem))
    in.fail(fmt::format("more than the {} atoms that the snapshot tells of", head.atoms));
  return read;
}

} // namespace tamp
