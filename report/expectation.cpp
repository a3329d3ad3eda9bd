// Writes, reads and checks expectations.
#include "report/expectation.h"

#include "engine/base/error.h"
#include "report/csv.h"
#include "report/symbols.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <tuple>

namespace tamp {

namespace {

constexpr std::array kTimed = {std::string_view("time"), std::string_view("fastest"), std::string_view("per cost"),
                               std::string_view("t_over_fit")};
constexpr std::string_view kHeader = "table,panel,row,column,expected,tolerance";

bool is_timed(std::string_view words) {
  return std::any_of(kTimed.begin(), kTimed.end(),
                     [&](std::string_view word) { return words.find(word) != words.npos; });
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

void add(std::map<CellPlace, std::string>& cells, CellPlace place, std::string text) {
  if (text.empty())
    return;
  const std::string column = place.column;
  for (int again = 2; cells.contains(place); ++again)
    place.column = fmt::format("{} #{}", column, again);
  cells.emplace(std::move(place), std::move(text));
}

void add_line(std::map<CellPlace, std::string>& cells, const Table& table, const Panel& panel, const Group& group,
              const Group::Line& line) {
  const std::string row = line.name.empty() ? group.heading : group.heading + ", " + line.name;
  for (std::size_t i = 0; i < line.cells.size(); ++i) {
    const Cell& cell = line.cells[i];
    const std::string& column = cell.quantity.empty() ? panel.columns[i].quantity : cell.quantity;
    if (cell.empty() || is_timed(column))
      continue;
    add(cells, {table.name, panel.title, row, column}, cell.word.empty() ? csv_number(cell.value) : cell.word);
    add(cells, {table.name, panel.title, row, column + " sd"}, csv_number(cell.spread));
  }
}

/// The fields of one record of RFC 4180 without line breaks inside of fields.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      fields.back() += line[i++];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

bool agrees(const ExpectedCell& cell, const std::string& found) {
  const auto a = number(cell.expected);
  const auto b = number(found);
  return a && b ? std::abs(*a - *b) <= cell.tolerance : cell.expected == found;
}

/// Table, panel and row in plain text.
std::string row_words(const CellPlace& place) {
  return fmt::format("{}{}{}: {}", place.table, place.panel.empty() ? "" : ", ", plain_text(place.panel),
                     plain_text(place.row));
}

std::string where(const CellPlace& place) {
  return fmt::format("{}: {}", row_words(place), plain_text(place.column));
}

/// The row a cell stands in.
CellPlace row_of(CellPlace place) {
  place.column.clear();
  return place;
}

} // namespace

std::map<CellPlace, std::string> comparable_cells(std::span<const Table> tables) {
  std::map<CellPlace, std::string> cells;
  for (const Table& table : tables) {
    for (const Panel& panel : table.panels) {
      for (const Group& group : panel.groups) {
        if (is_timed(panel.title) || (table.name == "decision" && is_timed(group.heading)))
          continue;
        for (const Group::Line& line : group.lines)
          add_line(cells, table, panel, group, line);
      }
    }
  }
  return cells;
}

std::string expectation_csv(std::string_view campaign, std::string_view version, std::span<const Run> runs,
                            std::span<const Table> tables) {
  std::string date;
  std::string commit;
  for (const Run& run : runs) {
    if (run.generation && run.generation->provenance.end_utc > date)
      std::tie(date, commit) = std::tie(run.generation->provenance.end_utc, run.generation->provenance.commit);
  }
  std::string out = fmt::format("# campaign: {}\n# version: {}\n# date: {}\n# commit: {}\n", campaign, version,
                                date.substr(0, date.find('T')), commit);
  out += "# left out, as they depend on the machine: times and all that follows from them\n";
  out += fmt::format("{}\n", kHeader);
  for (const auto& [place, text] : comparable_cells(tables)) {
    const auto value = number(text);
    const std::string tolerance =
        value ? csv_number(std::max(kExpectedAbsolute, kExpectedRelative * std::abs(*value))) : std::string();
    out += csv_record(std::array{place.table, place.panel, place.row, place.column, text, tolerance});
  }
  return out;
}

std::vector<ExpectedCell> read_expectation(std::string_view text, std::string_view file) {
  std::vector<ExpectedCell> cells;
  bool headed = false;
  int line_number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_number;
    if (line.empty() || line.front() == '#')
      continue;
    if (!headed) {
      if (line != kHeader)
        throw InputError(fmt::format("{}:{}: not an expectation: it must begin with {}", file, line_number, kHeader));
      headed = true;
      continue;
    }
    const std::vector<std::string> fields = fields_of(line);
    const auto tolerance = fields.size() == 6 && !fields[5].empty() ? number(fields[5]) : std::optional(0.0);
    if (fields.size() != 6 || !tolerance || !(*tolerance >= 0))
      throw InputError(
          fmt::format("{}:{}: expected six fields, the last a tolerance of at least 0", file, line_number));
    cells.push_back({{fields[0], fields[1], fields[2], fields[3]}, fields[4], *tolerance});
  }
  if (cells.empty())
    throw InputError(fmt::format("{}: expects nothing", file));
  return cells;
}

ExpectationCheck check_expectation(std::span<const ExpectedCell> expected, std::span<const Table> tables) {
  std::map<CellPlace, std::string> found = comparable_cells(tables);
  ExpectationCheck check;
  check.checked = expected.size();
  for (const ExpectedCell& cell : expected) {
    const auto place = found.find(cell.place);
    if (place == found.end())
      check.moved.push_back({cell, {}});
    else if (!agrees(cell, place->second))
      check.moved.push_back({cell, place->second});
  }
  std::set<CellPlace> present;
  for (const auto& [place, text] : found)
    present.insert(row_of(place));
  for (const ExpectedCell& cell : expected) {
    if (!present.contains(row_of(cell.place)))
      check.missing_rows.insert(row_of(cell.place));
    found.erase(cell.place);
  }
  for (const auto& [place, text] : found)
    check.unforeseen.push_back(place);
  return check;
}

std::string in_words(const ExpectationCheck& check) {
  std::string out;
  for (const CellPlace& row : check.missing_rows)
    out += row_words(row) + ": the row is missing\n";
  for (const auto& [cell, found] : check.moved) {
    if (!found.empty())
      out += fmt::format("{}: expected {}, found {}, tolerance {}\n", where(cell.place), cell.expected, found,
                         csv_number(cell.tolerance));
    else if (!check.missing_rows.contains(row_of(cell.place)))
      out += fmt::format("{}: missing; expected {}\n", where(cell.place), cell.expected);
  }
  return out + fmt::format("{} cells checked, {} moved or missing, {} of which nothing is expected\n", check.checked,
                           check.moved.size(), check.unforeseen.size());
}

} // namespace tamp
