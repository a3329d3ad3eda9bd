// What a report's tables are expected to say, as a file that is kept, and where they have moved since.
#pragma once

#include "report/runs.h"
#include "report/table.h"

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// Relative to the value. The same keys give the same bytes, so all that may move is what the last digits of
/// mathematical functions leave to the machine.
inline constexpr double kExpectedRelative = 1e-9;
/// Below this a number of order 1, such as an overlap relative to a radius, is nothing but rounding.
inline constexpr double kExpectedAbsolute = 1e-9;

/// Where a number stands: names as in CSV tables, told apart by " #2", " #3" where a place would repeat itself.
struct CellPlace {
  std::string table;
  std::string panel;
  std::string row;
  std::string column; ///< "… sd" for the standard deviation
  // clang-tidy 14 sees a literal 0 here. NOLINTNEXTLINE(modernize-use-nullptr)
  auto operator<=>(const CellPlace&) const = default;
};

/// All words and numbers, with all digits, but those that depend on the machine (times and what follows from them).
std::map<CellPlace, std::string> comparable_cells(std::span<const Table> tables);

/// An expectation as CSV: lines "# name: value" (campaign, version, date and commit of the records, what is left out),
/// then table,panel,row,column,expected,tolerance. `version` is that of the program. The date is the latest among the
/// records.
std::string expectation_csv(std::string_view campaign, std::string_view version, std::span<const Run> runs,
                            std::span<const Table> tables);

struct ExpectedCell {
  CellPlace place;
  std::string expected;
  double tolerance = 0; ///< absolute; of numbers
};

/// Reads what expectation_csv wrote. Throws InputError naming `file` and the line.
std::vector<ExpectedCell> read_expectation(std::string_view text, std::string_view file);

struct Moved {
  ExpectedCell cell;
  std::string found; ///< empty: the tables have no such cell
};

struct ExpectationCheck {
  std::vector<Moved> moved;          ///< in the order of the file
  std::set<CellPlace> missing_rows;  ///< without a column
  std::vector<CellPlace> unforeseen; ///< cells of which the expectation says nothing
  std::size_t checked = 0;
};

ExpectationCheck check_expectation(std::span<const ExpectedCell> expected, std::span<const Table> tables);

/// One line for each row that is missing altogether and each other cell that moved, and a summary; newline at the end.
std::string in_words(const ExpectationCheck& check);

} // namespace tamp
