// Everything wrong with one campaign file, collected so that it can be told at once.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// A value's JSON pointer, and the byte where it (or what should hold it) stands.
struct Place {
  std::string pointer;
  std::size_t offset = 0;
};

struct Mistake {
  Place place;
  std::string what;    ///< with the offending value
  std::string allowed; ///< may be empty
  std::string nearest; ///< the nearest known word; may be empty
};

class Mistakes {
public:
  /// `file` is its name in messages; `text` must outlive this.
  Mistakes(std::string file, std::string_view text) : sources_{{std::move(file), text, 0}} {}

  /// Adds a further file, whose text must outlive this, too. Returns what its bytes' numbers have to be raised by, so
  /// that one number tells file and byte.
  std::size_t add_source(std::string file, std::string_view text);

  /// The file that a byte belongs to.
  [[nodiscard]] const std::string& file_at(std::size_t offset) const { return source_of(offset).file; }

  void add(Mistake mistake) { found_.push_back(std::move(mistake)); }
  [[nodiscard]] std::size_t count() const { return found_.size(); }

  /// The text of a value as the user wrote it, on one line, shortened if long.
  [[nodiscard]] std::string written(std::size_t begin, std::size_t end) const;

  /// Throws InputError if anything was added: one paragraph a mistake, in the order of the file:
  ///   FILE:LINE:COLUMN: at POINTER: WHAT
  ///     allowed: ALLOWED
  ///     nearest: NEAREST
  void throw_if_any() const;

private:
  struct Source {
    std::string file;
    std::string_view text;
    std::size_t begin;
  };
  [[nodiscard]] const Source& source_of(std::size_t offset) const;

  std::vector<Source> sources_; ///< one behind the other, with a byte between
  std::vector<Mistake> found_;
};

} // namespace tamp
