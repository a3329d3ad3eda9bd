// Puts the digits of a cell together.
#include "report/cell_text.h"

#include "report/number.h"

#include <fmt/format.h>

namespace tamp {

namespace {

constexpr std::string_view kThinSpace = "\u2009";

std::string superscript(int exponent) {
  return fmt::format("<sup>{}{}</sup>", exponent < 0 ? "−" : "", exponent < 0 ? -exponent : exponent);
}

/// Digits with thin spaces and a real minus sign.
std::string digits(std::string_view number) {
  std::string out = grouped(number, kThinSpace);
  return out.starts_with('-') ? "−" + out.substr(1) : out;
}

} // namespace

std::string marked_cell(const Cell& cell, const std::function<std::string(std::string_view)>& text) {
  if (cell.empty())
    return "–";
  if (!cell.word.empty())
    return text(cell.word);
  const CellText shown = show(cell);
  std::string out = digits(shown.value);
  if (shown.exponent)
    out += "·10" + superscript(*shown.exponent);
  if (!shown.spread.empty())
    out += " ± " + digits(shown.spread);
  if (cell.doubtful)
    out = "(" + out + ")";
  if (shown.unit == "x")
    out += "×";
  else if (!shown.unit.empty())
    out += " " + shown.unit;
  if (!shown.relative.empty())
    out += fmt::format(" ({} %)", digits(shown.relative));
  return out;
}

} // namespace tamp
