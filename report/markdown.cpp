// Writes tables in Markdown.
#include "report/markdown.h"

#include "report/number.h"
#include "report/symbols.h"

#include <fmt/format.h>

namespace tamp {

namespace {

constexpr std::string_view kThinSpace = "\u2009";

std::string markdown(std::string_view text) {
  return render_text(text, markdown_text, [](const Symbol& symbol) { return std::string(symbol.markdown); });
}

std::string superscript(int exponent) {
  return fmt::format("<sup>{}{}</sup>", exponent < 0 ? "−" : "", exponent < 0 ? -exponent : exponent);
}

/// Digits with thin spaces and a real minus sign.
std::string digits(std::string_view number) {
  std::string out = grouped(number, kThinSpace);
  return out.starts_with('-') ? "−" + out.substr(1) : out;
}

std::string markdown_cell(const Cell& cell) {
  if (cell.empty())
    return "–";
  if (!cell.word.empty())
    return markdown(cell.word);
  const CellText text = show(cell);
  std::string out = digits(text.value);
  if (text.exponent)
    out += "·10" + superscript(*text.exponent);
  if (!text.spread.empty())
    out += " ± " + digits(text.spread);
  if (cell.doubtful)
    out = "(" + out + ")";
  if (text.unit == "x")
    out += "×";
  else if (!text.unit.empty())
    out += " " + text.unit;
  if (!text.relative.empty())
    out += fmt::format(" ({} %)", digits(text.relative));
  return out;
}

std::string markdown_panel(const Panel& panel) {
  const bool flat = panel.one_line_groups();
  std::string out = "**" + markdown(panel.title) + "**\n\n| Method |" + (flat ? "" : " |");
  std::string rule = flat ? "|:--|" : "|:--|:--|";
  for (const Column& column : panel.columns) {
    out += " " + markdown("⟨" + column.quantity + "⟩");
    if (!column.unit.empty() && column.unit != "1")
      out += " (" + markdown(column.unit) + ")";
    if (!column.remark.empty())
      out += " " + markdown(column.remark);
    out += " |";
    rule += "--:|";
  }
  out += "\n" + rule + "\n";
  for (const Group& group : panel.groups) {
    for (std::size_t i = 0; i < group.lines.size(); ++i) {
      // A line without a method of its own belongs to the one above.
      std::string head = i == 0 ? "**" + markdown(group.heading) + "**" : "";
      if (i == 0 && !group.remark.empty())
        head += " " + markdown(group.remark);
      out += "| " + head + " |" + (flat ? "" : " " + markdown(group.lines[i].name) + " |");
      for (const Cell& cell : group.lines[i].cells)
        out += " " + markdown_cell(cell) + " |";
      out += "\n";
    }
  }
  return out + "\n";
}

} // namespace

std::string markdown_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("\\`*_{}[]<>#|~&$").find(c) != std::string_view::npos)
      out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out;
}

std::string markdown_table(const Table& table) {
  std::string out = fmt::format("## {}\n\n{}\n\n", markdown_text(table.name), markdown(table.caption));
  for (const Panel& panel : table.panels)
    out += markdown_panel(panel);
  for (const Note& note : table.notes)
    out += fmt::format("- **{}.** {}\n", markdown(note.heading), markdown(note.text));
  return out;
}

std::string markdown_page(std::string_view title, std::string_view opening, std::span<const Table> tables) {
  std::string out = fmt::format("# {}\n\n{}\n", markdown(title), markdown(opening));
  for (const Table& table : tables)
    out += "\n" + markdown_table(table);
  return out;
}

} // namespace tamp
