// Writes scripts and data blocks.
#include "report/figures/figure.h"

#include "report/figures/style.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

namespace tamp {

namespace {

/// A comment of one line.
std::string one_line(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    c = c == '\n' ? ' ' : c;
  return out;
}

} // namespace

std::string figure_script(const Figure& figure) {
  std::string out = fmt::format("# {0}\n# gnuplot {1}.gp draws {1}.svg, {1}.pdf and {1}.png.\n"
                                "do for [format in 'svg pdf png'] {{\nreset\nload '{2}'\n",
                                one_line(figure.caption), figure.name, kStyleFile);
  out += fmt::format("eval terminal(format, '{}', {}, {})\n", figure.name, figure.width_cm, figure.height_cm);
  return out + figure.commands + "unset output\n}\n";
}

std::string gnuplot_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "\u2019"; // not the quote that would end the text
    else if (std::string_view("{}^_@&~\\").find(c) != std::string_view::npos)
      out += std::string("\\") + c; // marks of gnuplot's enhanced text
    else
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

std::string slug(std::string_view words) {
  std::string out;
  for (const char c : words) {
    const auto letter = static_cast<unsigned char>(c);
    if (letter < 0x80 && std::isalnum(letter) != 0)
      out += static_cast<char>(std::tolower(letter));
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_')
    out.pop_back();
  return out;
}

std::size_t DataBlocks::add(std::string_view title, std::span<const std::string_view> columns,
                            std::span<const std::vector<double>> rows) {
  if (count_ > 0)
    text_ += "\n\n"; // what parts the blocks
  text_ += fmt::format("# index {}: {}\n# {}\n", count_, one_line(title), fmt::join(columns, " "));
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      text_ += (i > 0 ? " " : "") + (std::isnan(row[i]) ? std::string("NaN") : fmt::format("{}", row[i]));
    text_ += '\n';
  }
  return count_++;
}

} // namespace tamp
