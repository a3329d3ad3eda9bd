// Writes JSON in the one canonical form of RFC 8785, so that equal content has equal bytes and one hash.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tamp {

/// A leaf of a canonical document.
using JsonLeaf = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

/// A document given as path → leaf, with '/' between the keys of nested objects ("scene/psd/mu_ln").
using JsonPaths = std::map<std::string, JsonLeaf>;

/// RFC 8785 text of the document: keys sorted by UTF-16 code units, numbers as ECMAScript prints them, no white space.
/// Keys here are ASCII, where UTF-16 order is byte order. Throws Error for a number that JSON cannot hold (NaN,
/// infinity).
std::string canonical_json(const JsonPaths& document);

/// A double as ECMAScript's Number::toString prints it (shortest digits that read back the same).
std::string canonical_number(double value);

/// A JSON string literal with the escapes of RFC 8785.
std::string canonical_string(std::string_view text);

} // namespace tamp
