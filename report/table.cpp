// Digits of cells.
#include "report/table.h"

#include "report/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

constexpr int kSignificant = 3;

/// Replicates that agree to this share of their mean differ by rounding alone, which is no spread.
constexpr double kRounding = 1e-9;

bool has_spread(const Cell& cell) {
  return std::isfinite(cell.spread) && cell.spread > kRounding * std::abs(cell.value);
}

/// Size of the shown unit in units of the value.
double shown_unit(const Cell& cell) {
  return cell.style == CellStyle::duration ? time_unit(std::abs(cell.value)).seconds : 1;
}

std::string with_sign(const Cell& cell, std::string digits) {
  const bool zero = digits.find_first_of("123456789") == std::string::npos;
  return cell.sign && !zero && digits.front() != '-' ? "+" + digits : digits;
}

} // namespace

bool Cell::empty() const {
  return !std::isfinite(value) && word.empty();
}

bool Panel::one_line_groups() const {
  return std::all_of(groups.begin(), groups.end(),
                     [](const Group& group) { return group.lines.size() == 1 && group.lines[0].name.empty(); });
}

int shown_decimals(const Cell& cell) {
  const double scale = shown_unit(cell);
  if (has_spread(cell))
    return decimals_of_spread(cell.spread / scale);
  return cell.decimals.value_or(std::max(0, decimals_of_significant(cell.value / scale, kSignificant)));
}

CellText show(const Cell& cell) {
  CellText text;
  switch (cell.style) {
  case CellStyle::scientific: {
    const Scientific parts = scientific(cell.value);
    text.value = with_sign(cell, parts.mantissa);
    text.exponent = parts.exponent;
    break;
  }
  case CellStyle::share:
    text.value = share(cell.value);
    break;
  case CellStyle::ratio:
    text.value = fixed(cell.value, decimals_of_significant(cell.value, 2));
    text.unit = "x";
    break;
  case CellStyle::fixed:
  case CellStyle::duration: {
    const double scale = shown_unit(cell);
    const int decimals = shown_decimals(cell);
    text.value = with_sign(cell, fixed(cell.value / scale, decimals));
    if (has_spread(cell))
      text.spread = fixed(cell.spread / scale, decimals);
    if (cell.style == CellStyle::duration)
      text.unit = time_unit(std::abs(cell.value)).name;
    break;
  }
  }
  if (std::isfinite(cell.relative))
    text.relative = fmt::format("{:+.1f}", 100 * cell.relative);
  return text;
}

void drop_empty_columns(Panel& panel) {
  for (std::size_t column = panel.columns.size(); column-- > 0;) {
    const bool used = std::any_of(panel.groups.begin(), panel.groups.end(), [&](const Group& group) {
      return std::any_of(group.lines.begin(), group.lines.end(),
                         [&](const Group::Line& line) { return !line.cells[column].empty(); });
    });
    if (used)
      continue;
    const auto at = static_cast<std::ptrdiff_t>(column);
    panel.columns.erase(panel.columns.begin() + at);
    for (Group& group : panel.groups) {
      for (Group::Line& line : group.lines)
        line.cells.erase(line.cells.begin() + at);
    }
  }
}

} // namespace tamp
