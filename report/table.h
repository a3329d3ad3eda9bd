// The abstract table between the figures and the formats: cells with value, spread, unit and digits; notes below.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// How a cell's number is shown. duration: in s, min, h or d; share: cut to six digits, so that 1 means all;
/// ratio: with two significant digits and ×; scientific: two significant digits and a power of ten.
enum class CellStyle { fixed, scientific, share, duration, ratio };

/// One cell; empty() if it has neither a number nor a word. Numbers are kept exact here, in `unit`; digits are a matter
/// of show().
struct Cell {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double value = kNone;
  double spread = kNone; ///< standard deviation; decides the digits of the value unless it is rounding
  std::size_t n = 0;     ///< numbers behind the value; 0 where it is not a statistic
  CellStyle style = CellStyle::fixed;
  std::string_view unit = "1";
  std::optional<int> decimals;    ///< after the point, in the unit shown, without a spread; else 3 significant digits
  bool sign = false;              ///< show + too
  double relative = kNone;        ///< shown behind the value in per cent
  bool doubtful = false;          ///< shown in parentheses, as the paper does with what it calls anomalous
  std::string quantity;           ///< in CSV files, where it is not that of the column
  std::string word;               ///< shown instead of a number: how a job ended
  std::vector<std::string> keys;  ///< of the generation jobs whose runs are behind it; empty for printed figures
  std::vector<double> run_values; ///< the number of each key's run, where it is not a measure of the column's name

  [[nodiscard]] bool empty() const;
};

/// A cell's digits, the same in every format: ASCII, without grouping. `spread`, `unit` and `relative` may be empty.
/// `unit` is that of a duration or "x" for a ratio; other units stand in the heading of the column.
struct CellText {
  std::string value;
  std::string spread;
  std::optional<int> exponent;
  std::string unit;
  std::string relative;
};

/// Digits of a cell that is not empty.
CellText show(const Cell& cell);

/// Digits after the point (in the unit shown) with which show() writes a fixed or duration cell.
int shown_decimals(const Cell& cell);

struct Column {
  std::string quantity; ///< name of a symbol (report/symbols.h)
  std::string unit;     ///< shown in the heading unless it is "1" or empty
  std::string remark;   ///< shown in the heading
};

/// Lines of one method. `heading` names it, `remark` stands behind the name.
struct Group {
  struct Line {
    std::string name; ///< "this run", "paper", …; empty where the group has but one line
    std::vector<Cell> cells;
  };
  std::string heading;
  std::string remark;
  std::vector<Line> lines;
};

/// A grid. Where every group is one unnamed line, the heading is the first cell of that line.
struct Panel {
  std::string title;
  std::vector<Column> columns;
  std::vector<Group> groups;
  std::string rows = "Method"; ///< what the headings of the groups are

  [[nodiscard]] bool one_line_groups() const;
};

/// Takes away the columns in which no line has anything.
void drop_empty_columns(Panel& panel);

/// Texts of captions and notes may mention symbols (report/symbols.h).
struct Note {
  std::string heading;
  std::string text;
};

/// A figure that a document shows from its files, NAME.pdf and others.
struct FigureMention {
  std::string name;
  std::string caption;
};

struct Table {
  std::string name; ///< of its files and its LaTeX label
  std::string caption;
  std::vector<Panel> panels;
  std::vector<Note> notes;
};

} // namespace tamp
