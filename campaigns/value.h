// From a value of the file to a value of a parameter, judged by the parameter's row alone.
#pragma once

#include "campaigns/json_document.h"
#include "campaigns/mistakes.h"
#include "engine/model/parameter.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// What a row says about its value, whichever root the row belongs to. Views the row.
struct ValueRule {
  ParameterKind kind = ParameterKind::number;
  Range range;
  std::span<const std::string_view> choices;
  std::string_view unit;
  std::string_view doc;
  std::string_view when;

  template <class Root>
  explicit ValueRule(const Parameter<Root>& row)
      : kind(row.kind), range(row.range), choices(row.choices), unit(row.unit), doc(row.doc), when(row.when) {}

  /// In words: "a number above 0 (length): Radius of equal spheres."
  [[nodiscard]] std::string allowed() const;
};

/// Whether values of the kind can enter arithmetic: numbers, whole numbers and lists of (one) number.
constexpr bool is_numeric(ParameterKind kind) {
  return kind == ParameterKind::number || kind == ParameterKind::integer || kind == ParameterKind::numbers;
}

/// The value as a leaf of the rule's kind: a whole number may be written 200, 200.0 or 2e2; where a list of numbers is
/// due, one number is a list of one. Nothing, and a mistake, if the value is of another kind or not allowed.
std::optional<JsonLeaf> read_value(const JsonNode& node, const ValueRule& rule, const std::string& pointer,
                                   Mistakes& mistakes);

/// As listings show a leaf: text without quotes, the rest as JSON.
std::string leaf_words(const JsonLeaf& leaf);

/// `"a", "b", "c"`.
std::string quoted_list(std::span<const std::string> words);

} // namespace tamp
