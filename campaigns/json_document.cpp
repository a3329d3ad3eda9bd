// A recursive-descent JSON parser that keeps positions and explains syntax errors in words.
#include "campaigns/json_document.h"

#include "campaigns/utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>

namespace tamp {

namespace {

constexpr std::size_t kDeepest = 64; ///< nesting that no campaign needs; keeps hostile text off the stack

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ||
         c == '+' || c == '-' || c == '$';
}

class Parser {
public:
  explicit Parser(std::string_view text) : text_(text) {}

  JsonDocument document() {
    if (const auto bad = first_invalid_utf8(text_))
      fail("this byte is not UTF-8; save the file as UTF-8", *bad);
    if (text_.substr(0, 3) == "\xEF\xBB\xBF")
      at_ = 3;
    skip_blanks();
    if (at_end())
      fail("the file is empty; expected an object: { … }", at_);
    value(document_.root, "");
    skip_blanks();
    if (!at_end())
      fail("expected the end of the file after the outermost value, found " + found(), at_);
    return std::move(document_);
  }

private:
  [[noreturn]] void fail(const std::string& message, std::size_t at) const {
    throw JsonSyntaxError(message, pointer_, at);
  }
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char here() const { return at_end() ? '\0' : text_[at_]; }
  [[nodiscard]] std::size_t line_of(std::size_t offset) const { return line_column(text_, offset).line; }

  /// The word or character at the present place, for messages.
  [[nodiscard]] std::string found() const {
    if (at_end())
      return "the end of the file";
    std::size_t end = at_;
    if (text_[at_] == '"')
      end = std::min(text_.find_first_of("\"\n", at_ + 1), text_.size() - 1) + 1;
    while (end < text_.size() && end - at_ < 40 && is_word(text_[end]))
      ++end;
    return end == at_ ? "'" + std::string(text_.substr(at_, utf8_length(text_[at_]))) + "'"
                      : std::string(text_.substr(at_, std::min<std::size_t>(end - at_, 60)));
  }

  void skip_blanks() {
    while (!at_end()) {
      if (const char c = here(); c == ' ' || c == '\t' || c == '\n' || c == '\r') {
        ++at_;
      } else if (text_.substr(at_, 2) == "//") {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos)
          fail("the comment that opens here is never closed; expected */", at_);
        at_ = end + 2;
      } else {
        return;
      }
    }
  }

  void value(JsonNode& node, const std::string& pointer) {
    pointer_ = pointer;
    if (depth_ >= kDeepest)
      fail(fmt::format("values are nested more than {} deep", kDeepest), at_);
    node.offset = at_;
    switch (here()) {
    case '{':
      object(node, pointer);
      break;
    case '[':
      list(node, pointer);
      break;
    case '"':
      node.kind = JsonNode::Kind::text;
      node.text = string();
      break;
    default:
      word(node);
    }
    node.end = at_;
    pointer_ = pointer;
  }

  /// After a member or an item: true if another follows, false if `close` ends the collection.
  bool more(char close, std::size_t open, std::string_view what) {
    const std::size_t after_value = at_; // where a forgotten comma belongs
    skip_blanks();
    if (here() == close) {
      ++at_;
      return false;
    }
    if (at_end())
      fail(fmt::format("the file ends inside the {} that opens in line {}; expected ',' or '{}'", what, line_of(open),
                       close),
           at_);
    if (here() != ',')
      fail(fmt::format("expected ',' or '{}' after the value, found {}{}", close, found(),
                       line_of(at_) > line_of(after_value) ? fmt::format(" in line {}", line_of(at_)) : ""),
           after_value);
    const std::size_t comma = at_++;
    skip_blanks();
    if (here() == close)
      fail(fmt::format("expected another value after this ',', found '{}'; remove the comma", close), comma);
    return true;
  }

  void object(JsonNode& node, const std::string& pointer) {
    node.kind = JsonNode::Kind::object;
    const std::size_t open = at_++;
    ++depth_;
    skip_blanks();
    bool another = here() != '}';
    if (!another)
      ++at_;
    while (another) {
      JsonMember member;
      member.offset = at_;
      if (at_end())
        fail(
            fmt::format("the file ends inside the object that opens in line {}; expected a key or '}}'", line_of(open)),
            at_);
      if (here() != '"')
        fail("expected a key in double quotes, found " + found(), at_);
      member.key = string();
      const std::string inner = json_pointer(pointer, member.key);
      pointer_ = inner;
      skip_blanks();
      if (here() != ':')
        fail(fmt::format("expected ':' after the key \"{}\", found {}", member.key, found()), at_);
      ++at_;
      skip_blanks();
      value(member.value, inner);
      const auto first = std::find_if(node.members.begin(), node.members.end(),
                                      [&](const JsonMember& other) { return other.key == member.key; });
      if (first != node.members.end())
        document_.duplicates.push_back({inner, member.offset, first->offset});
      else
        node.members.push_back(std::move(member));
      pointer_ = pointer;
      another = more('}', open, "object");
    }
    --depth_;
  }

  void list(JsonNode& node, const std::string& pointer) {
    node.kind = JsonNode::Kind::list;
    const std::size_t open = at_++;
    ++depth_;
    skip_blanks();
    bool another = here() != ']';
    if (!another)
      ++at_;
    while (another) {
      JsonNode item;
      value(item, json_pointer(pointer, std::to_string(node.items.size())));
      node.items.push_back(std::move(item));
      pointer_ = pointer;
      another = more(']', open, "list");
    }
    --depth_;
  }

  std::string string() {
    const std::size_t open = at_++;
    std::string out;
    for (;;) {
      if (at_end() || here() == '\n' || here() == '\r')
        fail("the text that opens here has no closing '\"' on its line", open);
      const char c = text_[at_++];
      if (c == '"')
        return out;
      if (static_cast<unsigned char>(c) < 0x20)
        fail("a control character cannot stand inside a text; write \\t for a tab", at_ - 1);
      if (c == '\\')
        escape(out);
      else
        out += c;
    }
  }

  void escape(std::string& out) {
    constexpr std::string_view codes = "\"\\/bfnrt";
    constexpr std::string_view meanings = "\"\\/\b\f\n\r\t";
    const std::size_t start = at_ - 1;
    const char c = here();
    if (c == 'u' && !at_end()) {
      ++at_;
      append_utf8(out, code_point(start));
    } else if (const std::size_t i = codes.find(c); !at_end() && i != std::string_view::npos) {
      ++at_;
      out += meanings[i];
    } else {
      fail("unknown escape in a text; allowed: \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\uXXXX (write a backslash as \\\\)",
           start);
    }
  }

  unsigned four_digits(std::size_t start) {
    unsigned code = 0;
    const auto digits = text_.substr(at_, 4);
    const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (digits.size() < 4 || end.ptr != digits.data() + 4)
      fail("expected four hexadecimal digits after \\u", start);
    at_ += 4;
    return code;
  }

  /// The character after "\u"; those beyond 16 bits come as a pair of surrogates.
  unsigned code_point(std::size_t start) {
    const unsigned high = four_digits(start);
    if (high < 0xD800 || high > 0xDFFF)
      return high;
    if (high < 0xDC00 && text_.substr(at_, 2) == "\\u") {
      at_ += 2;
      if (const unsigned low = four_digits(start); low >= 0xDC00 && low <= 0xDFFF)
        return 0x10000U + ((high - 0xD800U) << 10U) + (low - 0xDC00U);
    }
    fail("\\u names half a character; write both halves or the character itself", start);
  }

  /// A number or one of the bare words.
  void word(JsonNode& node) {
    std::size_t end = at_;
    while (end < text_.size() && is_word(text_[end]))
      ++end;
    const std::string_view spelling = text_.substr(at_, end - at_);
    if (spelling == "true" || spelling == "false") {
      node.kind = JsonNode::Kind::boolean;
      node.truth = spelling == "true";
    } else if (spelling != "null") {
      number(node, spelling);
    }
    at_ = end;
  }

  void number(JsonNode& node, std::string_view spelling) {
    node.kind = JsonNode::Kind::number;
    node.text = spelling;
    const bool negative = !spelling.empty() && spelling.front() == '-';
    const std::string_view size = spelling.substr(negative ? 1 : 0);
    if (size == "NaN" || size == "nan") {
      node.number = std::numeric_limits<double>::quiet_NaN();
    } else if (size == "Infinity" || size == "inf") {
      node.number = negative ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    } else if (size.empty() || !(size.front() >= '0' && size.front() <= '9')) {
      if (!size.empty() && size.front() == '.')
        fail("a number needs a digit before the point, found " + found(), at_);
      if (here() == '\'')
        fail("expected a value; a text stands in double quotes, not in single ones", at_);
      fail(fmt::format("expected a value (a number, a text in double quotes, true, false, {{ … }} or [ … ]), found {}",
                       found()),
           at_);
    } else {
      decimal(node, spelling, size);
    }
  }

  void decimal(JsonNode& node, std::string_view spelling, std::string_view size) {
    std::size_t i = 0;
    const auto digits = [&] {
      const std::size_t begin = i;
      while (i < size.size() && size[i] >= '0' && size[i] <= '9')
        ++i;
      return i > begin;
    };
    bool good = digits() && !(size[0] == '0' && i > 1);
    if (good && i < size.size() && size[i] == '.') {
      ++i;
      good = digits();
    }
    if (good && i < size.size() && (size[i] == 'e' || size[i] == 'E')) {
      ++i;
      if (i < size.size() && (size[i] == '+' || size[i] == '-'))
        ++i;
      good = digits();
    }
    if (!good || i != size.size())
      fail("expected a number such as 12, 0.5 or 1e-6, found " + std::string(spelling), at_);
    const auto end = std::from_chars(spelling.data(), spelling.data() + spelling.size(), node.number);
    if (end.ec == std::errc::result_out_of_range)
      node.number = std::strtod(node.text.c_str(), nullptr); // says which: 0 or infinity
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
  std::string pointer_;
  JsonDocument document_;
};

} // namespace

const JsonNode* JsonNode::find(std::string_view key) const {
  for (const JsonMember& member : members) {
    if (member.key == key)
      return &member.value;
  }
  return nullptr;
}

JsonDocument parse_json(std::string_view text) {
  return Parser(text).document();
}

std::string json_pointer(const std::string& pointer, std::string_view step) {
  std::string out = pointer + '/';
  for (const char c : step) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else
      out += c;
  }
  return out;
}

LineColumn line_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const std::size_t begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const std::string_view line = before.substr(begin);
  const auto characters = std::count_if(line.begin(), line.end(), [](char c) { return !is_utf8_continuation(c); });
  return {static_cast<std::size_t>(lines) + 1, static_cast<std::size_t>(characters) + 1};
}

} // namespace tamp
