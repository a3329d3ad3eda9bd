// RFC 8785 (JSON Canonicalization Scheme) for documents given as sorted paths.
#include "engine/base/canonical_json.h"

#include "engine/base/error.h"

#include <array>
#include <charconv>
#include <cmath>

namespace tamp {

namespace {

struct Tree {
  std::map<std::string, Tree> children;
  const JsonLeaf* leaf = nullptr;
};

void print(const JsonLeaf& leaf, std::string& out) {
  struct Printer {
    std::string& out;
    void operator()(bool b) const { out += b ? "true" : "false"; }
    void operator()(std::int64_t i) const { out += std::to_string(i); }
    void operator()(double d) const { out += canonical_number(d); }
    void operator()(const std::string& s) const { out += canonical_string(s); }
    void operator()(const std::vector<double>& list) const {
      out += '[';
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (i > 0)
          out += ',';
        out += canonical_number(list[i]);
      }
      out += ']';
    }
  };
  std::visit(Printer{out}, leaf);
}

void print(const Tree& tree, std::string& out) {
  if (tree.leaf != nullptr)
    return print(*tree.leaf, out);
  out += '{';
  bool first = true;
  for (const auto& [key, child] : tree.children) {
    if (!first)
      out += ',';
    first = false;
    out += canonical_string(key) + ':';
    print(child, out);
  }
  out += '}';
}

} // namespace

std::string canonical_number(double value) {
  if (!std::isfinite(value))
    throw Error("a number that is not finite has no JSON form");
  if (value == 0)
    return "0"; // also −0, as RFC 8785 asks
  std::array<char, 32> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(value), std::chars_format::scientific);
  const std::string_view text(buffer.data(), static_cast<std::size_t>(end.ptr - buffer.data()));
  const std::size_t mark = text.find('e');
  std::string digits(1, text[0]);
  if (mark > 2)
    digits += text.substr(2, mark - 2);
  int exponent = 0;
  const char* first = text.data() + mark + (text[mark + 1] == '+' ? 2 : 1);
  std::from_chars(first, text.data() + text.size(), exponent);

  // ECMA-262, Number::toString: value = 0.d1d2…dk × 10^n
  const int k = static_cast<int>(digits.size());
  const int n = exponent + 1;
  constexpr int largest_plain = 21;
  constexpr int smallest_plain = -6;
  std::string out = value < 0 ? "-" : "";
  const auto zeros = [](int count) { return std::string(static_cast<std::size_t>(count), '0'); };
  if (k <= n && n <= largest_plain)
    return out + digits + zeros(n - k);
  if (0 < n && n <= largest_plain)
    return out + digits.substr(0, static_cast<std::size_t>(n)) + '.' + digits.substr(static_cast<std::size_t>(n));
  if (smallest_plain < n && n <= 0)
    return out + "0." + zeros(-n) + digits;
  out += digits[0];
  if (k > 1)
    out += '.' + digits.substr(1);
  return out + 'e' + (n > 0 ? '+' : '-') + std::to_string(std::abs(n - 1));
}

std::string canonical_string(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    switch (c) {
    case '"':
      out += "\\\"";
      break;
    case '\\':
      out += "\\\\";
      break;
    case '\b':
      out += "\\b";
      break;
    case '\f':
      out += "\\f";
      break;
    case '\n':
      out += "\\n";
      break;
    case '\r':
      out += "\\r";
      break;
    case '\t':
      out += "\\t";
      break;
    default:
      if (const auto byte = static_cast<unsigned char>(c); byte < 0x20) {
        out += "\\u00";
        out += digits[byte >> 4U];
        out += digits[byte & 15U];
      } else {
        out += c;
      }
    }
  }
  return out + '"';
}

std::string canonical_json(const JsonPaths& document) {
  Tree root;
  for (const auto& [path, leaf] : document) {
    Tree* node = &root;
    for (std::size_t begin = 0;;) {
      const std::size_t slash = path.find('/', begin);
      node = &node->children[path.substr(begin, slash - begin)];
      if (slash == std::string::npos)
        break;
      begin = slash + 1;
    }
    node->leaf = &leaf;
  }
  std::string out;
  print(root, out);
  return out;
}

} // namespace tamp
