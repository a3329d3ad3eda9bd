// The table of formats, and how a file tells which one it has.
#include "store/formats/format.h"

#include "engine/base/error.h"
#include "engine/base/line_reader.h"
#include "store/formats/makers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

namespace tamp {

namespace {

constexpr std::array kFormats = {
    Format{"h5", ".h5", "HDF5 with the names of H5MD, as the store has it", export_hdf5, import_hdf5},
    Format{"csv", ".csv", "a sphere a line: x,y,z,r below a header with the unit", write_csv, read_csv},
    Format{"xyz", ".xyz .extxyz", "extended XYZ for OVITO and ASE", write_xyz, read_xyz},
    Format{"lammps-data", ".data .lmp", "what LAMMPS's read_data takes, atom_style sphere", export_lammps_data,
           import_lammps_data},
    Format{"lammps-dump", ".dump .lammpstrj", "a LAMMPS text dump: id type x y z radius", export_lammps_dump,
           import_lammps_dump},
    Format{"vtp", ".vtp", "VTK PolyData for ParaView, with coordination", write_vtp, read_vtp},
    Format{"yade", ".txt .yade", "plain text x y z r, as of Yade", write_yade, read_yade},
    Format{"mercury", ".mercury", "MercuryDPM's .data; without unit and sides", write_mercury, read_mercury},
    Format{"meta-image", ".mhd", "voxels for solvers on grids: raw bytes and a MetaImage header", write_meta_image,
           nullptr},
    Format{"stl", ".stl", "the surface of a small packing, binary, in single precision", write_stl, nullptr},
};

/// Formats whose files begin with bytes of their own.
struct Mark {
  std::string_view bytes;
  std::string_view format;
};
constexpr std::array kMarks = {Mark{"#format x_y", "yade"}, Mark{"\x89HDF\r\n\x1a\n", "h5"},
                               Mark{"ITEM: ", "lammps-dump"}, Mark{"LAMMPS data file", "lammps-data"}};

/// Whether a text begins as a snapshot of MercuryDPM does, whose ending .data is LAMMPS's too: 6 or 8 numbers.
bool begins_as_mercury(std::string_view begin) {
  std::string_view line = trimmed(begin.substr(0, begin.find('\n')));
  std::size_t numbers = 0;
  for (double value = 0; !line.empty(); ++numbers) {
    const std::size_t end = std::min(line.find_first_of(" \t\r"), line.size());
    if (!parse_number(line.substr(0, end), value))
      return false;
    line = trimmed(line.substr(end));
  }
  return begin.find('\n') != begin.npos && (numbers == 6 || numbers == 8);
}

std::string all_names() {
  std::string names;
  for (const Format& format : kFormats)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

bool has_ending(const Format& format, std::string_view ending) {
  std::string_view rest = format.endings;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == ending)
      return true;
    rest = rest.substr(std::min(end + 1, rest.size()));
  }
  return false;
}

} // namespace

std::span<const Format> formats() {
  return kFormats;
}

const Format& format_named(std::string_view name) {
  const auto* row = std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& f) { return f.name == name; });
  if (row == kFormats.end())
    throw InputError(fmt::format("unknown format \"{}\"; allowed: {}", name, all_names()));
  return *row;
}

const Format& format_of_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* row = std::find_if(kFormats.begin(), kFormats.end(),
                                 [&](const Format& f) { return !ending.empty() && has_ending(f, ending); });
  if (row == kFormats.end())
    throw InputError(
        fmt::format("{}: the ending \"{}\" tells no format; known are {}", path.string(), ending, all_names()));
  return *row;
}

const Format& format_of_file(const std::filesystem::path& path) {
  std::array<char, 512> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  const std::string_view begin(bytes.data(), static_cast<std::size_t>(file.gcount()));
  for (const Mark& mark : kMarks) {
    if (begin.starts_with(mark.bytes))
      return format_named(mark.format);
  }
  return path.extension() == ".data" && begins_as_mercury(begin) ? format_named("mercury") : format_of_ending(path);
}

ReadPacking read_foreign(const std::filesystem::path& path, const Surroundings& stated) {
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("there is no file {}", path.string()));
  const Format& format = format_of_file(path);
  if (format.read == nullptr)
    throw InputError(fmt::format("{}: the format {} is written only, not read", path.string(), format.name));
  return format.read(path, stated);
}

} // namespace tamp
