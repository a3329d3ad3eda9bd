// Makes cells.
#include "report/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace tamp {

double micrometres(LengthUnit unit) {
  constexpr std::array<double, 4> factors = {1e-3, 1, 1e3, 1e6}; // nm, um, mm, m
  return factors[static_cast<std::size_t>(unit)];
}

std::string_view unit_text(LengthUnit unit) {
  return unit == LengthUnit::um ? "µm" : name_of(unit);
}

bool agrees(double a, double b, double relative) {
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

Cell count_cell(double value) {
  Cell cell;
  cell.value = value;
  cell.decimals = 0;
  return cell;
}

Cell printed_cell(const Printed& printed) {
  Cell cell;
  cell.value = printed.value;
  cell.decimals = printed.decimals;
  return cell;
}

Cell edge_cell(double edge_um) {
  Cell cell;
  cell.value = edge_um;
  cell.unit = "um";
  cell.decimals = edge_um == std::round(edge_um) ? std::optional<int>(0) : std::nullopt;
  return cell;
}

Cell time_cell(double seconds) {
  Cell cell;
  cell.value = seconds;
  cell.style = CellStyle::duration;
  cell.unit = "s";
  return cell;
}

Cell time_cell(const GroupTime& time) {
  Cell cell = time_cell(time.seconds.median);
  cell.spread = time.seconds.sd;
  cell.n = time.seconds.n;
  cell.keys = time.keys;
  return cell;
}

Cell word_cell(std::string word) {
  Cell cell;
  cell.word = std::move(word);
  return cell;
}

Cell difference_cell(const Cell& run, const Cell& paper, bool count) {
  Cell cell;
  if (!std::isfinite(run.value) || !std::isfinite(paper.value))
    return cell;
  cell.value = run.value - paper.value;
  cell.decimals = std::min(shown_decimals(run), shown_decimals(paper));
  cell.sign = true;
  cell.keys = run.keys;
  if (count)
    cell.relative = cell.value / paper.value;
  return cell;
}

Cell speed_cell(const Cell& run, const Cell& paper) {
  Cell cell;
  if (!std::isfinite(run.value) || run.value <= 0 || !std::isfinite(paper.value))
    return cell;
  cell.value = paper.value / run.value;
  cell.style = CellStyle::ratio;
  cell.keys = run.keys;
  cell.quantity = "time of the paper / time of this run";
  return cell;
}

std::string start_remark(const RunGroup& group) {
  const std::string words = group.start_in_words();
  return words.empty() ? words : "; from " + words;
}

std::string protocol_remark(const RunGroup& group) {
  const std::string words = other_protocol(group.job().method);
  return words.empty() ? words : "; not the paper's protocol: " + words;
}

Column heading(const Quantity& quantity) {
  return {quantity.symbol == "bins" ? "K" : std::string(quantity.symbol), "1", ""};
}

std::string other_outcomes(const RunGroup& group) {
  std::set<Outcome> seen;
  for (const Run& run : group.runs) {
    if (run.generation && !run.ok())
      seen.insert(run.generation->outcome);
  }
  std::string words;
  for (const Outcome outcome : seen)
    words += (words.empty() ? "" : ", ") + std::string(name_of(outcome));
  const bool barred = std::any_of(group.runs.begin(), group.runs.end(),
                                  [](const Run& run) { return !run.generation && run.barrier() != nullptr; });
  if (barred)
    words += words.empty() ? "not possible" : ", not possible";
  return words;
}

} // namespace tamp
