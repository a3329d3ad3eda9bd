// Writes tables in LaTeX with booktabs rules; numbers are siunitx's.
#include "report/latex.h"

#include "report/symbols.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace tamp {

namespace {

using Pair = std::pair<std::string_view, std::string_view>;

/// Longest first where one is the beginning of another. "--" would become a dash.
constexpr std::array kMarks = {
    Pair{"\\", "\\textbackslash{}"},
    Pair{"{", "\\{"},
    Pair{"}", "\\}"},
    Pair{"$", "\\$"},
    Pair{"&", "\\&"},
    Pair{"#", "\\#"},
    Pair{"%", "\\%"},
    Pair{"_", "\\_"},
    Pair{"^", "\\textasciicircum{}"},
    Pair{"~", "\\textasciitilde{}"},
    Pair{"<", "\\textless{}"},
    Pair{">", "\\textgreater{}"},
    Pair{"|", "\\textbar{}"},
    Pair{"\"", "''"},
    Pair{"-", "-{}"},
    Pair{"±", "$\\pm$"},
    Pair{"×", "$\\times$"},
    Pair{"−", "$-$"},
    Pair{"≈", "$\\approx$"},
    Pair{"≤", "$\\le$"},
    Pair{"≥", "$\\ge$"},
    Pair{"·", "$\\cdot$"},
    Pair{"∩", "$\\cap$"},
    Pair{"²", "$^2$"},
    Pair{"³", "$^3$"},
    Pair{"⁴", "$^4$"},
    Pair{"µ", "$\\mu$"},
    Pair{"μ", "$\\mu$"},
    Pair{"σ", "$\\sigma$"},
    Pair{"φ", "$\\varphi$"},
    Pair{"ρ", "$\\rho$"},
    Pair{"√", "$\\surd$"},
    Pair{"–", "--"},
    Pair{"—", "---"},
    Pair{"…", "\\ldots{}"},
    Pair{"⟨", "$\\langle$"},
    Pair{"⟩", "$\\rangle$"},
};

/// Bytes of the UTF-8 character at the beginning of `text` (1 for a byte that begins none).
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 1;
  return std::min(length, text.size());
}

/// Letters of Latin-1 and Latin Extended-A (U+00C0 to U+017F): two bytes, the first from C3 to C5.
bool european_letter(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character.front());
  return character.size() == 2 && lead >= 0xC3 && lead <= 0xC5;
}

std::string latex(std::string_view text) {
  return render_text(text, latex_text, [](const Symbol& symbol) { return std::string(symbol.latex); });
}

std::string latex_cell(const Cell& cell) {
  if (cell.empty())
    return "--";
  if (!cell.word.empty())
    return latex(cell.word);
  const CellText text = show(cell);
  std::string number = text.value;
  if (!text.spread.empty())
    number += " +- " + text.spread;
  if (text.exponent)
    number += fmt::format("e{}", *text.exponent);
  const bool unit = !text.unit.empty() && text.unit != "x";
  std::string out = unit ? fmt::format("\\qty{{{}}}{{{}}}", number, text.unit) : fmt::format("\\num{{{}}}", number);
  if (text.unit == "x")
    out += "$\\times$";
  if (cell.doubtful)
    out = "(" + out + ")";
  if (!text.relative.empty())
    out += fmt::format(" (\\qty{{{}}}{{\\percent}})", text.relative);
  return out;
}

std::string latex_heading(const Column& column) {
  std::string out = latex("⟨" + column.quantity + "⟩");
  if (!column.unit.empty() && column.unit != "1")
    out += " (" + latex(column.unit) + ")";
  if (!column.remark.empty())
    out += " " + latex(column.remark);
  return out;
}

/// A grid wider than the text shrinks to its width.
constexpr std::string_view kShrink = "\\resizebox{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}{!}{%\n";

std::string latex_panel(const Panel& panel) {
  const bool flat = panel.one_line_groups();
  std::string out = fmt::format("{}\\\\[2pt]\n{}\\begin{{tabular}}{{l{}}}\n\\toprule\n{}", latex(panel.title), kShrink,
                                std::string(panel.columns.size(), 'r'), flat ? latex(panel.rows) : "");
  for (const Column& column : panel.columns)
    out += " & " + latex_heading(column);
  out += " \\\\\n\\midrule\n";
  for (std::size_t g = 0; g < panel.groups.size(); ++g) {
    const Group& group = panel.groups[g];
    if (!flat) {
      out += g == 0 ? "" : "\\addlinespace\n";
      out += fmt::format("\\multicolumn{{{}}}{{l}}{{\\textbf{{{}}} {}}} \\\\\n", panel.columns.size() + 1,
                         latex(group.heading), latex(group.remark));
    }
    for (const Group::Line& line : group.lines) {
      out += flat ? latex(group.heading) : "\\quad " + latex(line.name);
      for (const Cell& cell : line.cells)
        out += " & " + latex_cell(cell);
      out += " \\\\\n";
    }
  }
  return out + "\\bottomrule\n\\end{tabular}}\\par\\medskip\n";
}

/// Rows that fit on a page of A4, and rows that leave room for notes below them.
constexpr std::size_t kRowsOfPage = 54;
constexpr std::size_t kRowsAboveNotes = 30;

/// Rows of a panel with its title and heading.
std::size_t rows_of(const Panel& panel) {
  std::size_t rows = 3;
  for (const Group& group : panel.groups)
    rows += group.lines.size() + (panel.one_line_groups() ? 0 : 1);
  return rows;
}

/// How siunitx is to print numbers: the same digits as in the other formats.
constexpr std::string_view kNumbers =
    "\\sisetup{separate-uncertainty,retain-explicit-plus,group-digits=integer,exponent-product=\\cdot}\n";

std::string open_float() {
  return "\\begin{table}[!htbp]\n\\centering\\footnotesize\n\\setlength{\\tabcolsep}{4pt}\n";
}

} // namespace

std::string latex_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto* mark = &kMarks.front();
    while (mark != &kMarks.back() + 1 && !text.starts_with(mark->first))
      ++mark;
    if (mark != &kMarks.back() + 1) {
      out += mark->second;
      text.remove_prefix(mark->first.size());
      continue;
    }
    const std::string_view character = text.substr(0, character_length(text));
    const auto lead = static_cast<unsigned char>(character.front());
    if (lead < 0x20 || lead == 0x7F)
      out += ' ';
    else
      out += lead < 0x80 || european_letter(character) ? character : "?";
    text.remove_prefix(character.size());
  }
  return out;
}

std::string latex_fragment(const Table& table) {
  std::string out =
      fmt::format("% A table of tamp; needs \\usepackage{{booktabs,graphicx,siunitx}} and\n% {}", kNumbers) +
      open_float();
  out += fmt::format("\\caption{{{}}}\n\\label{{tab:{}}}\n\\medskip\n", latex(table.caption), table.name);
  std::size_t rows = 0;
  const auto next_page = [&] {
    out += fmt::format("\\end{{table}}\n{}\\addtocounter{{table}}{{-1}}\n\\caption{{(continued)}}\n\\medskip\n",
                       open_float());
    rows = 0;
  };
  for (const Panel& panel : table.panels) {
    if (rows > 0 && rows + rows_of(panel) > kRowsOfPage)
      next_page();
    rows += rows_of(panel);
    out += latex_panel(panel);
  }
  if (rows > kRowsAboveNotes)
    next_page();
  out += "\\begin{minipage}{\\linewidth}\\scriptsize\\raggedright\n";
  for (const Note& note : table.notes)
    out += fmt::format("\\textbf{{{}.}} {}\\par\\smallskip\n", latex(note.heading), latex(note.text));
  return out + "\\end{minipage}\n\\end{table}\n";
}

std::string latex_document(std::string_view title, std::span<const Table> tables,
                           std::span<const FigureMention> figures) {
  std::string out = "\\documentclass[a4paper,10pt]{article}\n\\usepackage[utf8]{inputenc}\n\\usepackage[T1]{fontenc}\n"
                    "\\usepackage{booktabs,graphicx,siunitx}\n\\usepackage[margin=15mm]{geometry}\n";
  out += kNumbers;
  out += "\\begin{document}\n";
  out += fmt::format("\\section*{{{}}}\n", latex(title));
  for (const Table& table : tables)
    out += fmt::format("\\input{{{}.tex}}\n\\clearpage\n", table.name);
  for (const FigureMention& figure : figures) { // a page each: LaTeX holds but few floats at a time
    out += fmt::format("\\begin{{figure}}[!htbp]\n\\centering\n{}\\includegraphics{{{}.pdf}}}}\n\\caption{{{}}}\n"
                       "\\end{{figure}}\n\\clearpage\n",
                       kShrink, figure.name, latex(figure.caption));
  }
  return out + "\\end{document}\n";
}

} // namespace tamp
