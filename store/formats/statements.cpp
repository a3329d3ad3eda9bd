// Comment lines with the surroundings of the spheres.
#include "store/formats/statements.h"

namespace tamp {

void write_statements(FileWriter& out, const Packing& packing) {
  out.print("# packing of spheres, by tamp\n# unit {}\n# dimension {}\n# box", name_of(packing.unit),
            packing.dimension);
  for (std::size_t a = 0; a < static_cast<std::size_t>(packing.dimension); ++a)
    out.print(" 0 {}", packing.size[a]);
  out.print("\n# boundary {}\n# count {}\n", boundary_text(packing), packing.count());
}

void read_statement(LineReader& in, Statements& found) {
  const std::string_view text = trimmed(in.line().substr(1));
  const std::size_t space = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, space);
  const std::string_view value = trimmed(text.substr(space));
  if (word == "unit") {
    found.said.unit = enum_of<LengthUnit>(value);
  } else if (word == "dimension" && (value == "2" || value == "3")) {
    found.said.dimension = value == "2" ? 2 : 3;
  } else if (word == "count") {
    found.count = in.to_integer(value, "the count");
  } else if (word == "boundary") {
    found.said.boundary = read_boundary(value);
  } else if (word == "box") {
    const std::vector<std::string_view>& f = in.fields(' ');
    for (std::size_t a = 0; a < 3 && 2 * a + 3 < f.size(); ++a)
      found.said.box[a] = {in.to_number(f[2 * a + 2], "a bound of the box"),
                           in.to_number(f[2 * a + 3], "a bound of the box")};
  }
}

void check_count(const LineReader& in, const Statements& found, std::size_t count) {
  if (found.count && *found.count != static_cast<std::int64_t>(count))
    in.fail(fmt::format("the file ends after {} spheres, but says that it has {}", count, *found.count));
}

std::string boundary_text(const Packing& packing) {
  std::string text;
  for (std::size_t a = 0; a < static_cast<std::size_t>(packing.dimension); ++a)
    text += fmt::format("{}{}", a == 0 ? "" : " ", name_of(packing.boundary[a]));
  return text;
}

std::array<std::optional<Boundary>, 3> read_boundary(std::string_view text) {
  std::array<std::optional<Boundary>, 3> sides;
  for (std::size_t a = 0; a < 3 && !text.empty(); ++a) {
    const std::size_t end = std::min(text.find(' '), text.size());
    sides[a] = enum_of<Boundary>(text.substr(0, end));
    text = trimmed(text.substr(end));
  }
  return sides;
}

} // namespace tamp
