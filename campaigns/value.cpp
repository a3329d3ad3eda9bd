// Kinds, ranges and choices of single values.
#include "campaigns/value.h"

#include "campaigns/nearest.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace tamp {

namespace {

using Kind = JsonNode::Kind;

std::string_view kind_words(const JsonNode& node) {
  switch (node.kind) {
  case Kind::null:
    return "null";
  case Kind::boolean:
    return "true or false";
  case Kind::number:
    return "a number";
  case Kind::text:
    return "a text";
  case Kind::list:
    return "a list";
  case Kind::object:
    return "an object";
  }
  return "";
}

std::string_view due_words(ParameterKind kind) {
  switch (kind) {
  case ParameterKind::boolean:
    return "true or false";
  case ParameterKind::integer:
    return "a whole number";
  case ParameterKind::number:
    return "a number";
  case ParameterKind::choice:
    return "a text";
  case ParameterKind::numbers:
    return "a number or a list of numbers";
  }
  return "";
}

/// The number as an integer, exactly; nothing if it has a fraction or is too large.
std::optional<std::int64_t> whole(const JsonNode& node) {
  std::int64_t out = 0;
  const char* end = node.text.data() + node.text.size();
  if (const auto [stop, error] = std::from_chars(node.text.data(), end, out); error == std::errc{} && stop == end)
    return out;
  constexpr double largest = 0x1.0p53; // beyond, doubles skip whole numbers
  if (std::trunc(node.number) != node.number || !(std::abs(node.number) <= largest))
    return std::nullopt;
  return static_cast<std::int64_t>(node.number);
}

/// Reads one value; each step either yields a leaf or says why not.
class ValueReader {
public:
  ValueReader(const ValueRule& rule, Mistakes& mistakes) : rule_(rule), mistakes_(mistakes) {}

  std::optional<JsonLeaf> read(const JsonNode& node, const std::string& pointer) {
    switch (rule_.kind) {
    case ParameterKind::boolean:
      if (node.kind == Kind::boolean)
        return node.truth;
      break;
    case ParameterKind::integer:
      return integer(node, pointer);
    case ParameterKind::number:
      if (const auto x = number(node, pointer))
        return *x;
      return std::nullopt;
    case ParameterKind::choice:
      return choice(node, pointer);
    case ParameterKind::numbers:
      return numbers(node, pointer);
    }
    return wrong_kind(node, pointer);
  }

private:
  std::nullopt_t refuse(const JsonNode& node, const std::string& pointer, std::string_view why, std::string near = {}) {
    mistakes_.add({{pointer, node.offset},
                   fmt::format("{} {}", mistakes_.written(node.offset, node.end), why),
                   rule_.allowed(),
                   std::move(near)});
    return std::nullopt;
  }

  std::nullopt_t wrong_kind(const JsonNode& node, const std::string& pointer) {
    return refuse(node, pointer,
                  node.kind == Kind::null ? fmt::format("where {} is due", due_words(rule_.kind))
                                          : fmt::format("is {}, not {}", kind_words(node), due_words(rule_.kind)));
  }

  std::optional<double> number(const JsonNode& node, const std::string& pointer) {
    if (node.kind != Kind::number)
      return wrong_kind(node, pointer);
    if (!std::isfinite(node.number))
      return refuse(node, pointer, "is not a finite number");
    if (!rule_.range.holds(node.number))
      return refuse(node, pointer, "is out of range");
    return node.number;
  }

  std::optional<JsonLeaf> integer(const JsonNode& node, const std::string& pointer) {
    if (!number(node, pointer))
      return std::nullopt;
    if (const auto n = whole(node))
      return *n;
    return refuse(node, pointer, "is not a whole number");
  }

  std::optional<JsonLeaf> choice(const JsonNode& node, const std::string& pointer) {
    if (node.kind != Kind::text)
      return wrong_kind(node, pointer);
    const std::vector<std::string> known(rule_.choices.begin(), rule_.choices.end());
    for (const std::string& name : known) {
      if (name == node.text)
        return node.text;
    }
    return refuse(node, pointer, "is no choice", nearest(node.text, known));
  }

  std::optional<JsonLeaf> numbers(const JsonNode& node, const std::string& pointer) {
    if (node.kind == Kind::number) {
      if (const auto x = number(node, pointer))
        return std::vector<double>{*x};
      return std::nullopt;
    }
    if (node.kind != Kind::list)
      return wrong_kind(node, pointer);
    if (node.items.empty())
      return refuse(node, pointer, "is an empty list");
    std::vector<double> out;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      if (const auto x = number(node.items[i], json_pointer(pointer, std::to_string(i))))
        out.push_back(*x);
    }
    if (out.size() < node.items.size())
      return std::nullopt;
    return out;
  }

  const ValueRule& rule_;
  Mistakes& mistakes_;
};

} // namespace

std::string ValueRule::allowed() const {
  std::string out(due_words(kind));
  if (kind == ParameterKind::choice) {
    const std::vector<std::string> names(choices.begin(), choices.end());
    out = (names.size() > 1 ? "one of " : "") + quoted_list(names);
  } else if (const std::string words = range.words(); kind != ParameterKind::boolean && words != "any number") {
    const std::string_view each = kind == ParameterKind::numbers ? ", each " : " ";
    out += fmt::format("{}{}", each, words);
  }
  if (unit != "1")
    out += fmt::format(" ({})", unit);
  return fmt::format("{}: {}", out, doc);
}

std::optional<JsonLeaf> read_value(const JsonNode& node, const ValueRule& rule, const std::string& pointer,
                                   Mistakes& mistakes) {
  return ValueReader(rule, mistakes).read(node, pointer);
}

std::string leaf_words(const JsonLeaf& leaf) {
  if (const auto* text = std::get_if<std::string>(&leaf))
    return *text;
  if (const auto* list = std::get_if<std::vector<double>>(&leaf)) {
    std::string out;
    for (const double x : *list)
      out += (out.empty() ? "" : ",") + canonical_number(x);
    return list->size() == 1 ? out : "[" + out + "]";
  }
  if (const auto* truth = std::get_if<bool>(&leaf))
    return *truth ? "true" : "false";
  if (const auto* whole_number = std::get_if<std::int64_t>(&leaf))
    return std::to_string(*whole_number);
  return canonical_number(std::get<double>(leaf));
}

std::string quoted_list(std::span<const std::string> words) {
  std::string out;
  for (const std::string& word : words)
    out += (out.empty() ? "\"" : ", \"") + word + "\"";
  return out;
}

} // namespace tamp
