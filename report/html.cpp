// Writes tables in HTML.
#include "report/html.h"

#include "report/cell_text.h"
#include "report/csv.h"
#include "report/symbols.h"

#include <fmt/format.h>

#include <cmath>

namespace tamp {

namespace {

/// A symbol's Markdown with its asterisks as <i>.
std::string html_symbol(const Symbol& symbol) {
  std::string out;
  bool open = false;
  for (const char c : symbol.markdown) {
    if (c != '*') {
      out += c;
      continue;
    }
    out += open ? "</i>" : "<i>";
    open = !open;
  }
  return out;
}

std::string html(std::string_view text) {
  return render_text(text, html_text, html_symbol);
}

std::string html_cell(const Cell& cell, const Column& column) {
  std::string out = "<td";
  if (std::isfinite(cell.value))
    out += fmt::format(" data-v=\"{}\"", csv_number(cell.value));
  if (!cell.keys.empty() && !cell.empty()) {
    out += fmt::format(" data-q=\"{}\" data-k=\"{}\" tabindex=\"0\" role=\"button\"", html_text(column.quantity),
                       fmt::join(cell.keys, " "));
    if (!cell.run_values.empty())
      out += fmt::format(" data-r=\"{}\"", fmt::join(cell.run_values, " "));
  }
  return out + ">" + marked_cell(cell, html) + "</td>";
}

std::string html_panel(const Panel& panel) {
  const bool flat = panel.one_line_groups();
  std::string out =
      "<h3>" + html(panel.title) + "</h3>\n<div class=\"wide\"><table>\n<thead><tr><th>" + html(panel.rows) + "</th>";
  if (!flat)
    out += "<th></th>";
  for (const Column& column : panel.columns) {
    out += "<th>" + html("⟨" + column.quantity + "⟩");
    if (!column.unit.empty() && column.unit != "1")
      out += " (" + html(column.unit) + ")";
    if (!column.remark.empty())
      out += " " + html(column.remark);
    out += "</th>";
  }
  out += "</tr></thead>\n";
  for (const Group& group : panel.groups) {
    out += "<tbody>";
    for (std::size_t i = 0; i < group.lines.size(); ++i) {
      out += "<tr><th scope=\"row\">" + (i == 0 ? html(group.heading) : std::string());
      if (i == 0 && !group.remark.empty())
        out += " <small>" + html(group.remark) + "</small>";
      out += "</th>";
      if (!flat)
        out += "<td>" + html(group.lines[i].name) + "</td>";
      for (std::size_t c = 0; c < group.lines[i].cells.size(); ++c)
        out += html_cell(group.lines[i].cells[c], panel.columns[c]);
      out += "</tr>";
    }
    out += "</tbody>\n";
  }
  return out + "</table></div>\n";
}

} // namespace

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '"':
      out += "&quot;";
      break;
    default:
      out += c;
    }
  }
  return out;
}

std::string html_table(const Table& table) {
  const std::string name = html_text(table.name);
  std::string out = fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", name, html(table.caption));
  for (const Panel& panel : table.panels)
    out += html_panel(panel);
  if (!table.notes.empty())
    out += "<details><summary>Notes</summary>\n";
  for (const Note& note : table.notes)
    out += fmt::format("<p><b>{}.</b> {}</p>\n", html(note.heading), html(note.text));
  return out + (table.notes.empty() ? "</section>\n" : "</details>\n</section>\n");
}

} // namespace tamp
