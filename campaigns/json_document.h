// JSON text (with // and /* */ comments) as a tree whose every value knows where in the text it stands.
#pragma once

#include "engine/base/error.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

struct JsonMember;

/// One value of the text, from byte `offset` up to but without byte `end`.
struct JsonNode {
  enum class Kind { null, boolean, number, text, list, object };
  Kind kind = Kind::null;
  std::size_t offset = 0;
  std::size_t end = 0;
  bool truth = false;
  double number =
      0; ///< also NaN or infinite where the text says so (NaN, Infinity, 1e999): not JSON, for readers to refuse
  std::string text; ///< of a text: unescaped; of a number: as written
  std::vector<JsonNode> items;
  std::vector<JsonMember> members; ///< in the order of the text

  /// The value of a key; null if there is none or this is no object.
  [[nodiscard]] const JsonNode* find(std::string_view key) const;
};

struct JsonMember {
  std::string key;
  std::size_t offset = 0; ///< of the key
  JsonNode value;
};

/// Text that is no JSON: what was expected, at which byte, inside which value.
struct JsonSyntaxError : InputError {
  JsonSyntaxError(const std::string& message, std::string where, std::size_t at)
      : InputError(message), pointer(std::move(where)), offset(at) {}
  std::string pointer; ///< JSON pointer of the innermost value begun
  std::size_t offset;
};

/// A key that stands twice in one object; only its first value is in the tree.
struct DuplicateKey {
  std::string pointer;
  std::size_t offset;       ///< of the second
  std::size_t first_offset; ///< of the first
};

struct JsonDocument {
  JsonNode root;
  std::vector<DuplicateKey> duplicates;
};

/// Parses RFC 8259 JSON with comments, and the words NaN and Infinity as numbers. Throws JsonSyntaxError.
JsonDocument parse_json(std::string_view text);

/// `pointer` extended by one step, escaped as RFC 6901 asks (~ as ~0, / as ~1).
std::string json_pointer(const std::string& pointer, std::string_view step);

/// Line and column of a byte, both from 1; columns count characters, not bytes.
struct LineColumn {
  std::size_t line;
  std::size_t column;
};
LineColumn line_column(std::string_view text, std::size_t offset);

} // namespace tamp
