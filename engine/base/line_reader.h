// Reads a text file line by line in bounded memory, and says of every mistake in which line it stands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// The number that the whole of `text` writes, in C notation ("nan" and "inf" included); false if it is none, or one
/// that a double cannot hold.
bool parse_number(std::string_view text, double& value);
bool parse_integer(std::string_view text, std::int64_t& value);

/// Throws InputError "file:line: message"; "file: message" for line 0.
[[noreturn]] void fail_in_line(const std::filesystem::path& path, std::size_t line, std::string_view message);

/// `text` without blanks at its ends.
std::string_view trimmed(std::string_view text);

/// One pass over the lines of a file. Views into a line are valid until next() is called again.
class LineReader {
public:
  /// Throws InputError if the file cannot be opened.
  explicit LineReader(std::filesystem::path path);

  /// Goes to the next line; false at the end. A line of more than kLongestLine bytes fails: that is not such a text.
  bool next();
  /// The same where there must be a line: fails saying that the file ends before `what`.
  void require(std::string_view what);

  /// Without its end, be that \n or \r\n.
  [[nodiscard]] std::string_view line() const { return line_; }
  /// Counts from 1.
  [[nodiscard]] std::size_t number() const { return number_; }
  /// Of the whole file: no more spheres can be in it than it has bytes.
  [[nodiscard]] std::uintmax_t file_size() const { return size_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// The parts of the line between blanks (spaces and tabs), or between separators with blanks around them removed.
  const std::vector<std::string_view>& fields();
  const std::vector<std::string_view>& fields(char separator);

  /// A field as a number; `what` names it in the message.
  [[nodiscard]] double to_number(std::string_view field, std::string_view what) const;
  [[nodiscard]] std::int64_t to_integer(std::string_view field, std::string_view what) const;

  /// Throws InputError about the present line.
  [[noreturn]] void fail(std::string_view message) const { fail_in_line(path_, number_, message); }

  static constexpr std::size_t kLongestLine = std::size_t{1} << 20U;

private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  bool refill();

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::uintmax_t size_ = 0;
  std::vector<char> buffer_;
  std::size_t begin_ = 0; // of what is not yet given out
  std::size_t end_ = 0;
  std::size_t number_ = 0;
  std::string_view line_;
  std::vector<std::string_view> fields_;
};

} // namespace tamp
