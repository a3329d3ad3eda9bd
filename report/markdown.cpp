// Writes tables in Markdown.
#include "report/markdown.h"

#include "report/cell_text.h"
#include "report/symbols.h"

#include <fmt/format.h>

namespace tamp {

namespace {

std::string markdown(std::string_view text) {
  return render_text(text, markdown_text, [](const Symbol& symbol) { return std::string(symbol.markdown); });
}

std::string markdown_panel(const Panel& panel) {
  const bool flat = panel.one_line_groups();
  std::string out = "**" + markdown(panel.title) + "**\n\n| " + markdown(panel.rows) + " |" + (flat ? "" : " |");
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
        out += " " + marked_cell(cell, markdown) + " |";
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

std::string markdown_page(std::string_view title, std::string_view opening, std::span<const Table> tables,
                          std::span<const FigureMention> figures, std::span<const std::string> missing) {
  std::string out = fmt::format("# {}\n\n{}\n", markdown(title), markdown(opening));
  for (const std::string& sentence : missing)
    out += fmt::format("\n{}\n", markdown_text(sentence));
  for (const Table& table : tables)
    out += "\n" + markdown_table(table);
  if (!figures.empty())
    out += "\n## Figures\n";
  for (const FigureMention& figure : figures)
    out += fmt::format("\n![{0}]({0}.svg)\n\n{1}\n", figure.name, markdown(figure.caption));
  return out;
}

} // namespace tamp
