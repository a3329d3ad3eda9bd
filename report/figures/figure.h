// A figure as plain data: a gnuplot script and the numbers it reads.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

struct FigureFile {
  std::string name;
  std::string bytes;
};

/// `commands` draw it, whatever the terminal; they read the files of `data`, which stand beside the script.
struct Figure {
  std::string name; ///< of its files: lower-case letters, digits and underscores
  std::string caption;
  double width_cm = 12;
  double height_cm = 8;
  std::string commands;
  std::vector<FigureFile> data;
};

/// Figures of one kind, and sentences on those that could not be made, each with the command that would help.
struct Figures {
  std::vector<Figure> figures;
  std::vector<std::string> missing;
};

/// The script NAME.gp: `gnuplot NAME.gp` in its folder draws NAME.svg, NAME.pdf and NAME.png.
std::string figure_script(const Figure& figure);

/// Text inside '…' of a script, in which no character means anything to gnuplot.
std::string gnuplot_text(std::string_view text);

/// Words as part of a file's name: "D&R, radius kept" → "d_r_radius_kept".
std::string slug(std::string_view words);

/// Blocks of numbers in one data file, numbered from 0 as gnuplot's `index` counts them. All digits; NaN for none.
class DataBlocks {
public:
  /// Adds a block and returns its index. A row has one number for each column.
  std::size_t add(std::string_view title, std::span<const std::string_view> columns,
                  std::span<const std::vector<double>> rows);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] const std::string& text() const { return text_; }

private:
  std::string text_;
  std::size_t count_ = 0;
};

} // namespace tamp
