// A window over the file that moves on line by line.
#include "engine/base/line_reader.h"

#include "engine/base/error.h"
#include "engine/base/system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

namespace tamp {

namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kShown = 40; // characters of a wrong field in a message

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) // from_chars knows no plus
    text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && !text.empty();
}

/// For a message: cut, and without what a terminal would obey.
std::string shown(std::string_view text) {
  std::string part(text.substr(0, kShown));
  std::replace_if(
      part.begin(), part.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }, '?');
  return text.size() > kShown ? part + "…" : part;
}

} // namespace

bool parse_number(std::string_view text, double& value) {
  return parse_whole(text, value);
}

bool parse_integer(std::string_view text, std::int64_t& value) {
  return parse_whole(text, value);
}

void fail_in_line(const std::filesystem::path& path, std::size_t line, std::string_view message) {
  if (line == 0)
    throw InputError(fmt::format("{}: {}", path.string(), message));
  throw InputError(fmt::format("{}:{}: {}", path.string(), line, message));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == text.npos ? text.substr(0, 0) : text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

LineReader::LineReader(std::filesystem::path path)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "rb")), buffer_(kLongestLine) {
  if (!file_)
    throw InputError(fmt::format("cannot open {}: {}", path_.string(), std::strerror(errno)));
  if (std::filesystem::is_directory(path_))
    throw InputError(fmt::format("{} is a folder", path_.string()));
  std::error_code unknown; // of a pipe
  size_ = std::filesystem::file_size(path_, unknown);
  if (unknown)
    size_ = 0;
}

bool LineReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_), buffer_.begin() + static_cast<std::ptrdiff_t>(end_),
            buffer_.begin());
  end_ -= begin_;
  begin_ = 0;
  const std::size_t got = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (got == 0 && std::ferror(file_.get()) != 0)
    throw system_error("cannot read " + path_.string(), errno);
  end_ += got;
  return got > 0;
}

bool LineReader::next() {
  std::size_t searched = begin_;
  for (;;) {
    const auto* found = static_cast<const char*>(std::memchr(buffer_.data() + searched, '\n', end_ - searched));
    if (found != nullptr) {
      const auto at = static_cast<std::size_t>(found - buffer_.data());
      line_ = {buffer_.data() + begin_, at - begin_};
      begin_ = at + 1;
      break;
    }
    if (end_ - begin_ == buffer_.size()) {
      ++number_;
      fail(fmt::format("a line of more than {} bytes: this is no such text file", kLongestLine));
    }
    const std::size_t kept = end_ - begin_;
    if (!refill()) {
      if (begin_ == end_)
        return false;
      line_ = {buffer_.data() + begin_, end_ - begin_};
      begin_ = end_;
      break;
    }
    searched = kept;
  }
  ++number_;
  if (line_.ends_with('\r'))
    line_.remove_suffix(1);
  return true;
}

void LineReader::require(std::string_view what) {
  if (!next()) {
    ++number_;
    fail(fmt::format("the file ends before {}: it is truncated", what));
  }
}

const std::vector<std::string_view>& LineReader::fields() {
  fields_.clear();
  for (std::size_t first = line_.find_first_not_of(kBlanks); first != line_.npos;) {
    const std::size_t last = std::min(line_.find_first_of(kBlanks, first), line_.size());
    fields_.push_back(line_.substr(first, last - first));
    first = line_.find_first_not_of(kBlanks, last);
  }
  return fields_;
}

const std::vector<std::string_view>& LineReader::fields(char separator) {
  fields_.clear();
  for (std::size_t first = 0;;) {
    const std::size_t last = std::min(line_.find(separator, first), line_.size());
    fields_.push_back(trimmed(line_.substr(first, last - first)));
    if (last == line_.size())
      return fields_;
    first = last + 1;
  }
}

double LineReader::to_number(std::string_view field, std::string_view what) const {
  double value = 0;
  if (!parse_number(field, value))
    fail(fmt::format("{} is \"{}\", which is no number", what, shown(field)));
  return value;
}

std::int64_t LineReader::to_integer(std::string_view field, std::string_view what) const {
  std::int64_t value = 0;
  if (!parse_integer(field, value))
    fail(fmt::format("{} is \"{}\", which is no whole number", what, shown(field)));
  return value;
}

} // namespace tamp
