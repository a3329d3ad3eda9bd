// Comment lines in which plain text files tell what their columns cannot: unit, dimension, box, sides, count.
#pragma once

#include "engine/base/file_writer.h"
#include "engine/base/line_reader.h"
#include "engine/model/packing_builder.h"

#include <optional>

namespace tamp {

/// Lines "# unit um", "# dimension 3", "# box 0 60 0 60 0 120" (low and high of each axis), "# boundary wall wall
/// open",
/// "# count 1000".
void write_statements(FileWriter& out, const Packing& packing);

struct Statements {
  Surroundings said;
  std::optional<std::int64_t> count;
};

/// Takes in the present line, which begins with '#', if it states something; other comments pass.
void read_statement(LineReader& in, Statements& found);

/// Fails if the file states another number of spheres than it has.
void check_count(const LineReader& in, const Statements& found, std::size_t count);

/// The sides written with blanks between; nothing where the text is not one word an axis.
std::string boundary_text(const Packing& packing);
std::array<std::optional<Boundary>, 3> read_boundary(std::string_view text);

} // namespace tamp
