// The JSON parser against another parser, its positions, and its words about broken text.
#include "campaigns/json_document.h"
#include "engine/base/random.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tamp::test {

namespace {

using Json = nlohmann::json;
using Kind = JsonNode::Kind;

/// The same document in the other parser's form.
Json converted(const JsonNode& node) {
  switch (node.kind) {
  case Kind::null:
    return nullptr;
  case Kind::boolean:
    return node.truth;
  case Kind::number:
    return node.number;
  case Kind::text:
    return node.text;
  case Kind::list: {
    Json out = Json::array();
    for (const JsonNode& item : node.items)
      out.push_back(converted(item));
    return out;
  }
  case Kind::object: {
    Json out = Json::object();
    for (const JsonMember& member : node.members)
      out[member.key] = converted(member.value);
    return out;
  }
  }
  return nullptr;
}

bool overflows(const JsonNode& node) {
  return !std::isfinite(node.number) || std::any_of(node.items.begin(), node.items.end(), overflows) ||
         std::any_of(node.members.begin(), node.members.end(), [](const auto& m) { return overflows(m.value); });
}

std::string random_text(RandomStream& random) {
  static const std::vector<std::string> pieces = {"a", "\\n", "\\\"", "é", "😀", "\\u00b5", "\\uD83D\\uDE00",
                                                  "/", " ",   "\\\\", "//"};
  std::string out = "\"";
  for (std::uint64_t i = random.below(5); i > 0; --i)
    out += pieces[random.below(pieces.size())];
  return out + '"';
}

std::string random_blank(RandomStream& random) {
  static const std::vector<std::string> blanks = {"", "", " ", "\n", "\t", "// x \" {\n", "/* \n } */", "\r\n"};
  return blanks[random.below(blanks.size())];
}

std::string random_number(RandomStream& random) {
  static const std::vector<std::string> numbers = {"0",   "-0",     "12",     "-7.25",
                                                   "1e6", "2.5E-3", "1e-320", "9007199254740993"};
  return random.below(3) == 0 ? std::to_string(random.uniform()) : numbers[random.below(numbers.size())];
}

std::string random_json(RandomStream& random, int depth) {
  const std::uint64_t kind = random.below(depth > 0 ? 7 : 5);
  std::string out = random_blank(random);
  if (kind < 5) {
    static const std::vector<std::string> words = {"null", "true", "false"};
    out += kind < 2 ? random_number(random) : kind < 4 ? random_text(random) : words[random.below(3)];
  } else {
    out += kind == 5 ? '[' : '{';
    const std::uint64_t count = random.below(4);
    for (std::uint64_t i = 0; i < count; ++i) {
      out += i > 0 ? "," : "";
      if (kind == 6)
        out += random_blank(random) + "\"k" + std::to_string(i) + "\"" + random_blank(random) + ":";
      out += random_json(random, depth - 1);
    }
    out += random_blank(random) + (kind == 5 ? ']' : '}');
  }
  return out + random_blank(random);
}

std::string syntax_error(std::string_view text) {
  try {
    parse_json(text);
  } catch (const JsonSyntaxError& error) {
    const auto [line, column] = line_column(text, error.offset);
    return std::to_string(line) + ":" + std::to_string(column) + " " + error.pointer + " " + error.what();
  }
  return "";
}

} // namespace

TEST_CASE("every document reads as another parser reads it") {
  RandomStream random("json", 0);
  for (int i = 0; i < 3000; ++i) {
    const std::string text = random_json(random, 4);
    INFO(text);
    const JsonDocument document = parse_json(text);
    REQUIRE(converted(document.root) == Json::parse(text, nullptr, true, true));
  }
}

TEST_CASE("broken documents are refused exactly where the other parser refuses") {
  RandomStream random("broken", 0);
  int refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = random_json(random, 3);
    if (text.empty())
      continue;
    constexpr std::string_view bytes = "{}[]:,\"0-.e/*atn \n\\";
    text[random.below(text.size())] = bytes[random.below(bytes.size())];
    INFO(text);
    const Json other = Json::parse(text, nullptr, false, true);
    bool accepted = true;
    JsonDocument document;
    try {
      document = parse_json(text);
    } catch (const JsonSyntaxError& error) {
      accepted = false;
      ++refused;
      REQUIRE(error.offset <= text.size());
    }
    if (accepted && overflows(document.root))
      continue; // left to the readers here, refused at once there
    if (accepted && other.is_discarded())
      FAIL("only the other parser refuses");
    if (!accepted)
      REQUIRE(other.is_discarded());
    if (accepted && document.duplicates.empty())
      REQUIRE(converted(document.root) == other);
  }
  CHECK(refused > 1000);
}

TEST_CASE("values and keys know where they stand") {
  const std::string text = "{\n  \"größe\": [1,\n    {\"b\": true}]\n}";
  const JsonDocument document = parse_json(text);
  const JsonMember& member = document.root.members.at(0);
  const auto at = [&](std::size_t offset) {
    const auto [line, column] = line_column(text, offset);
    return std::pair(line, column);
  };
  CHECK(at(member.offset) == std::pair<std::size_t, std::size_t>(2, 3));
  CHECK(at(member.value.offset) == std::pair<std::size_t, std::size_t>(2, 12)); // characters, not bytes
  const JsonNode& inner = member.value.items.at(1);
  CHECK(text.substr(inner.offset, inner.end - inner.offset) == "{\"b\": true}");
  CHECK(at(inner.members.at(0).value.offset) == std::pair<std::size_t, std::size_t>(3, 11));
}

TEST_CASE("numbers beyond the doubles and the words NaN and Infinity are read for others to refuse") {
  CHECK(std::isnan(parse_json("NaN").root.number));
  CHECK(parse_json("-Infinity").root.number == -HUGE_VAL);
  CHECK(parse_json("1e999").root.number == HUGE_VAL);
  CHECK(parse_json("-1e999").root.number == -HUGE_VAL);
  CHECK(parse_json("1e-999").root.number == 0);
  std::string long_number(400, '0');
  long_number.front() = '1';
  CHECK(parse_json(long_number.append("e-398")).root.number == 10);
}

TEST_CASE("a repeated key keeps its first value and is reported with its place") {
  const JsonDocument document = parse_json("{\"a\": {\"b\": 1,\n\"b\": 2}}");
  REQUIRE(document.duplicates.size() == 1);
  CHECK(document.duplicates[0].pointer == "/a/b");
  CHECK(document.duplicates[0].offset == 15);
  CHECK(document.root.find("a")->find("b")->number == 1);
}

TEST_CASE("syntax errors say in words what was expected, where") {
  CHECK(syntax_error("") == "1:1  the file is empty; expected an object: { … }");
  CHECK(syntax_error("{\"a\": 1\n \"b\": 2}") == "1:8  expected ',' or '}' after the value, found \"b\" in line 2");
  CHECK(syntax_error("{\"a\": [1, 2}") == "1:12 /a expected ',' or ']' after the value, found '}'");
  CHECK(syntax_error("{\"a\": [1, 2,]}") ==
        "1:12 /a expected another value after this ',', found ']'; remove the comma");
  CHECK(syntax_error("{a: 1}") == "1:2  expected a key in double quotes, found a");
  CHECK(syntax_error("{\"a\" 1}") == "1:6 /a expected ':' after the key \"a\", found 1");
  CHECK(syntax_error("{\"a\": {\n\"b\": 1") ==
        "2:7 /a the file ends inside the object that opens in line 1; expected ',' or '}'");
  CHECK(syntax_error("{\"a\": \"x\n\"}") == "1:7 /a the text that opens here has no closing '\"' on its line");
  CHECK(syntax_error("{\"a\": 'x'}") == "1:7 /a expected a value; a text stands in double quotes, not in single ones");
  CHECK(syntax_error("{\"a\": .5}") == "1:7 /a a number needs a digit before the point, found .5");
  CHECK(syntax_error("{\"a\": 1.}") == "1:7 /a expected a number such as 12, 0.5 or 1e-6, found 1.");
  CHECK(syntax_error("{\"a\": 007}") == "1:7 /a expected a number such as 12, 0.5 or 1e-6, found 007");
  CHECK(syntax_error("{\"a\": yes}") ==
        "1:7 /a expected a value (a number, a text in double quotes, true, false, { … } or [ … ]), found yes");
  CHECK(syntax_error("{} {}") == "1:4  expected the end of the file after the outermost value, found '{'");
  CHECK(syntax_error("{} /* x") == "1:4  the comment that opens here is never closed; expected */");
  CHECK(syntax_error("{\"a\": \"\\x\"}").find("1:8 /a unknown escape in a text; allowed:") == 0);
  CHECK(syntax_error("{\"a\": \"\xff\"}") == "1:8  this byte is not UTF-8; save the file as UTF-8");
  CHECK(syntax_error(std::string(100000, '[')).find("nested more than 64 deep") != std::string::npos);
}

TEST_CASE("pointers escape as RFC 6901 asks") {
  CHECK(json_pointer("/sweep/grid", "scene/a~b") == "/sweep/grid/scene~1a~0b");
}

} // namespace tamp::test
