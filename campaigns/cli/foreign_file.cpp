// Reads --unit, --dimension, --box and --boundary.
#include "campaigns/cli/foreign_file.h"

#include "engine/base/error.h"
#include "engine/base/line_reader.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace tamp::cli {

namespace {

std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t first = 0; first <= text.size();) {
    const std::size_t last = std::min(text.find(',', first), text.size());
    parts.emplace_back(trimmed(std::string_view(text).substr(first, last - first)));
    first = last + 1;
  }
  return parts;
}

void read_box(const std::string& text, Surroundings& stated) {
  constexpr const char* kHelp = "--box {}: allowed are edges from 0, X,Y,Z, or bounds, XLO,XHI,YLO,YHI,ZLO,ZHI (in 2D "
                                "without Z)";
  std::vector<double> numbers;
  for (const std::string& part : parts_of(text)) {
    double number = 0;
    if (!parse_number(part, number))
      throw InputError(fmt::format(kHelp, text));
    numbers.push_back(number);
  }
  // Four or six numbers are bounds, two or three are edges.
  const bool bounds = numbers.size() > 3;
  if (numbers.size() < 2 || numbers.size() > 6 || numbers.size() == 5)
    throw InputError(fmt::format(kHelp, text));
  for (std::size_t a = 0; a < numbers.size() / (bounds ? 2 : 1); ++a)
    stated.box[a] = bounds ? Interval{numbers[2 * a], numbers[2 * a + 1]} : Interval{0, numbers[a]};
}

} // namespace

void add_surroundings_options(CLI::App& app, StatedSurroundings& stated) {
  app.add_option("--unit", stated.unit, "Unit of length of a file: nm, um, mm or m")->type_name("UNIT");
  app.add_option("--dimension", stated.dimension, "2 or 3; without, 2 if no sphere has another z than 0")
      ->type_name("D")
      ->check(CLI::IsMember({2, 3}));
  app.add_option("--box", stated.box, "X,Y,Z or XLO,XHI,YLO,YHI,ZLO,ZHI; without, the file's, or around the spheres")
      ->type_name("BOX");
  app.add_option("--boundary", stated.boundary, "wall, periodic or open: one word, or one for each axis, with commas")
      ->type_name("SIDES");
}

Surroundings surroundings_of(const StatedSurroundings& words) {
  Surroundings stated;
  if (!words.unit.empty()) {
    stated.unit = enum_of<LengthUnit>(words.unit);
    if (!stated.unit)
      throw InputError(fmt::format("--unit {}: allowed are nm, um, mm, m", words.unit));
  }
  if (words.dimension != 0)
    stated.dimension = words.dimension;
  if (!words.box.empty())
    read_box(words.box, stated);
  if (!words.boundary.empty()) {
    const std::vector<std::string> sides = parts_of(words.boundary);
    for (std::size_t a = 0; a < 3; ++a) {
      const std::string& side = sides[std::min(a, sides.size() - 1)];
      stated.boundary[a] = enum_of<Boundary>(side);
      if (!stated.boundary[a] || sides.size() > 3)
        throw InputError(
            fmt::format("--boundary {}: allowed are wall, periodic, open, one or one for each axis", words.boundary));
    }
  }
  return stated;
}

} // namespace tamp::cli
