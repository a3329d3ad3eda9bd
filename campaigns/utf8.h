// UTF-8: validity, lengths and encoding of characters.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tamp {

/// Offset of the first byte that begins no valid UTF-8 character (RFC 3629: no surrogates, no overlong forms).
std::optional<std::size_t> first_invalid_utf8(std::string_view text);

/// Whether a byte is the second, third or fourth of its character.
constexpr bool is_utf8_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// Number of bytes of the character that begins with this byte (1 to 4); the text must be valid.
constexpr std::size_t utf8_length(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

/// Appends the character of a code point.
void append_utf8(std::string& out, unsigned code_point);

} // namespace tamp
