// CSV of measured sizes: its header, its lines, and the classes they make.
#include "campaigns/histogram_file.h"

#include "engine/base/error.h"
#include "engine/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string>
#include <system_error>

namespace tamp {

namespace {

constexpr std::string_view kHeaderAllowed = "a first line such as \"radius (um)\" or \"diameter (um),count\"; the "
                                            "second column count or number, volume or mass, "
                                            "or weight";

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string_view::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// The words of a header cell in small letters; µ (both of Unicode's) reads as u.
std::set<std::string> words_of(std::string_view cell) {
  std::set<std::string> words;
  std::string word;
  for (std::size_t i = 0; i <= cell.size(); ++i) {
    if (const auto pair = cell.substr(std::min(i, cell.size()), 2); pair == "\xC2\xB5" || pair == "\xCE\xBC") {
      word += 'u';
      ++i;
      continue;
    }
    const char c = i < cell.size() ? cell[i] : ' ';
    if (c >= 'A' && c <= 'Z') {
      word += static_cast<char>(c - 'A' + 'a');
    } else if (c >= 'a' && c <= 'z') {
      word += c;
    } else if (!word.empty()) {
      words.insert(std::move(word));
      word.clear();
    }
  }
  return words;
}

bool any_of(const std::set<std::string>& words, std::initializer_list<const char*> wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const char* word) { return words.contains(word); });
}

struct Class {
  double low = 0; ///< equal to high: the centre of a class
  double high = 0;
  double weight = 1;
  std::size_t line = 0;
};

class SizesParser {
public:
  SizesParser(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  MeasuredSizes parse() {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF")
      text_.remove_prefix(3);
    bool headed = false;
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      const std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++line_;
      if (trimmed(line).empty() || trimmed(line).front() == '#')
        continue;
      if (headed)
        classes_.push_back(row(line));
      else
        header(line);
      headed = true;
    }
    if (!headed)
      fail(fmt::format("the file is empty; allowed: {}", kHeaderAllowed));
    if (classes_.empty())
      fail("the header is not followed by any size");
    if (columns_ == 1)
      bin();
    else if (classes_.front().low < classes_.front().high)
      join_ranges();
    else
      split_between_centres();
    for (double& edge : out_.edges)
      edge *= scale_;
    return std::move(out_);
  }

private:
  [[noreturn]] void fail(const std::string& message, std::size_t line = 0) const {
    throw InputError(fmt::format("{}:{}: {}", name_, line == 0 ? std::max<std::size_t>(line_, 1) : line, message));
  }

  [[nodiscard]] std::vector<std::string_view> cells(std::string_view line) const {
    std::vector<std::string_view> out;
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(separator_, begin), line.size());
      out.push_back(trimmed(line.substr(begin, end - begin)));
      begin = end + 1;
    }
    return out;
  }

  void header(std::string_view line) {
    for (const char candidate : {';', '\t', ','}) {
      if (line.find(candidate) != std::string_view::npos) {
        separator_ = candidate;
        break;
      }
    }
    const auto names = cells(line);
    columns_ = names.size();
    const auto sizes = words_of(names[0]);
    const bool diameter = any_of(sizes, {"diameter", "diameters", "d"});
    const bool radius = any_of(sizes, {"radius", "radii", "r"});
    if (columns_ > 2 || diameter == radius)
      fail(
          fmt::format("the header '{}' does not say what the columns are; allowed: {}", trimmed(line), kHeaderAllowed));
    scale_ = diameter ? 0.5 : 1.0;
    for (const LengthUnit unit : {LengthUnit::nm, LengthUnit::um, LengthUnit::mm, LengthUnit::m}) {
      if (sizes.contains(std::string(name_of(unit))))
        out_.unit = unit;
    }
    if (columns_ == 1) {
      out_.weighting = Weighting::number;
      return;
    }
    const auto weights = words_of(names[1]);
    const bool number = any_of(weights, {"count", "counts", "number", "n"});
    const bool volume = any_of(weights, {"volume", "mass"});
    const bool open = any_of(weights, {"weight", "weights", "frequency", "share", "fraction", "percent"});
    if ((number && volume) || !(number || volume || open))
      fail(fmt::format("the header '{}' does not say what the second column counts; allowed: {}", trimmed(line),
                       kHeaderAllowed));
    if (number || volume)
      out_.weighting = number ? Weighting::number : Weighting::volume;
  }

  /// Reads a number off the front of `text`.
  double number(std::string_view& text, std::string_view cell) const {
    double value = 0;
    const std::size_t end = std::min(text.find(".."), text.size()); // the first point of 4..8 is none of the number's
    const auto [stop, error] = std::from_chars(text.data(), text.data() + end, value);
    if (error != std::errc{} || !std::isfinite(value))
      fail(fmt::format("'{}' is no number; allowed: numbers such as 12, 0.5 or 1e-3, decimals with a point", cell));
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return value;
  }

  Class row(std::string_view line) const {
    const auto parts = cells(line);
    if (parts.size() != columns_)
      fail(fmt::format("'{}' has {} columns where the header has {} (decimals are written with a point)", trimmed(line),
                       parts.size(), columns_));
    Class out;
    out.line = line_;
    std::string_view rest = parts[0];
    out.low = out.high = number(rest, parts[0]);
    rest = trimmed(rest);
    if (!rest.empty()) {
      bool range = false;
      for (const std::string_view dash : {"..", "to", "-", "–"}) {
        if (columns_ == 2 && rest.substr(0, dash.size()) == dash) {
          rest = trimmed(rest.substr(dash.size()));
          range = true;
          break;
        }
      }
      if (!range)
        fail(fmt::format("'{}' is no size; allowed: a number{}", parts[0],
                         columns_ == 2 ? ", or a class such as 0.5-1.0" : ""));
      out.high = number(rest, parts[0]);
      if (!rest.empty() || out.high <= out.low)
        fail(fmt::format("'{}' is no class; allowed: LOW-HIGH with LOW below HIGH", parts[0]));
    }
    if (out.low < 0 || out.high <= 0)
      fail(fmt::format("the size {} is not positive", parts[0]));
    if (columns_ == 2) {
      rest = parts[1];
      out.weight = number(rest, parts[1]);
      if (!rest.empty() || out.weight < 0)
        fail(fmt::format("the weight '{}' is not allowed; allowed: numbers from 0", parts[1]));
    }
    return out;
  }

  /// Single sizes: classes of equal width in log(size), their number by Rice's rule.
  void bin() {
    std::vector<double> sizes;
    for (const Class& size : classes_)
      sizes.push_back(size.low);
    const auto [least, largest] = std::minmax_element(sizes.begin(), sizes.end());
    if (*least >= *largest)
      fail("a distribution needs at least two different sizes; for equal spheres use the law monodisperse");
    const auto count = static_cast<std::size_t>(std::ceil(2 * std::cbrt(static_cast<double>(sizes.size()))));
    const double ratio = std::log(*largest / *least);
    for (std::size_t i = 0; i < count; ++i) // the outermost edges are the extremes themselves, free of rounding
      out_.edges.push_back(*least * std::exp(ratio * static_cast<double>(i) / static_cast<double>(count)));
    out_.edges.push_back(*largest);
    if (std::adjacent_find(out_.edges.begin(), out_.edges.end(), std::greater_equal<>{}) != out_.edges.end())
      fail("the sizes differ by no more than rounding; for equal spheres use the law monodisperse");
    out_.weights.assign(count, 0);
    for (const double size : sizes) {
      const auto above = std::upper_bound(out_.edges.begin(), out_.edges.end(), size) - out_.edges.begin();
      out_.weights[std::min(static_cast<std::size_t>(above) - 1, count - 1)] += 1;
    }
  }

  /// Classes LOW-HIGH; a gap between two of them is a class without spheres.
  void join_ranges() {
    for (const Class& c : classes_) {
      if (c.low >= c.high)
        fail("a class LOW-HIGH is due here, as in the lines before", c.line);
      if (!out_.edges.empty() && c.low < out_.edges.back())
        fail("the class begins below the end of the class before it; allowed: increasing classes", c.line);
      if (out_.edges.empty())
        out_.edges.push_back(c.low);
      if (c.low > out_.edges.back()) {
        out_.edges.push_back(c.low);
        out_.weights.push_back(0);
      }
      out_.edges.push_back(c.high);
      out_.weights.push_back(c.weight);
    }
  }

  /// Classes given by their centres: edges halfway, the outermost classes symmetric.
  void split_between_centres() {
    if (classes_.size() < 2)
      fail("one class centre has no width; write the class as LOW-HIGH");
    for (std::size_t i = 0; i < classes_.size(); ++i) {
      const Class& c = classes_[i];
      if (c.low < c.high)
        fail("a single size is due here, as in the lines before", c.line);
      if (i > 0 && c.low <= classes_[i - 1].low)
        fail("class centres must increase", c.line);
      out_.edges.push_back(i == 0 ? c.low - (classes_[1].low - c.low) / 2 : (classes_[i - 1].low + c.low) / 2);
      out_.weights.push_back(c.weight);
    }
    const double last = classes_.back().low;
    out_.edges.push_back(last + (last - classes_[classes_.size() - 2].low) / 2);
    if (out_.edges.front() <= 0)
      fail("the first class would reach below 0; write classes as LOW-HIGH", classes_.front().line);
  }

  std::string_view text_;
  std::string name_;
  std::size_t line_ = 0;
  char separator_ = ',';
  std::size_t columns_ = 0;
  double scale_ = 1; ///< from the column's sizes to radii
  std::vector<Class> classes_;
  MeasuredSizes out_;
};

} // namespace

std::vector<double> MeasuredSizes::edges_in(LengthUnit target) const {
  std::vector<double> out = edges;
  constexpr double step = 1000; // between neighbours of nm, um, mm, m
  const int steps = static_cast<int>(unit.value_or(target)) - static_cast<int>(target);
  for (double& edge : out) {
    for (int i = 0; i < std::abs(steps); ++i)
      edge = steps > 0 ? edge * step : edge / step;
  }
  return out;
}

MeasuredSizes parse_measured_sizes(std::string_view text, const std::string& name) {
  return SizesParser(text, name).parse();
}

MeasuredSizes read_measured_sizes(const std::filesystem::path& file) {
  std::string text;
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored))
    throw InputError(file.string() + ": is not a file");
  try {
    text = read_file(file);
  } catch (const Error& error) {
    throw InputError(error.what());
  }
  return parse_measured_sizes(text, file.string());
}

} // namespace tamp
