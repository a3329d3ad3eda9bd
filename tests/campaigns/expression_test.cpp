// Values of expressions, the places of their errors, and that no text breaks the parser.
#include "campaigns/expression.h"
#include "engine/base/random.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <optional>

namespace tamp::test {

namespace {

double value_of(std::string_view text, const std::vector<double>& values = {}) {
  return Expression(text).value(values);
}

/// The byte at which the text is refused.
std::optional<std::size_t> refused_at(std::string_view text) {
  try {
    (void)Expression(text);
  } catch (const ExpressionError& error) {
    return error.at;
  }
  return std::nullopt;
}

} // namespace

TEST_CASE("expressions follow the rules of arithmetic") {
  CHECK(value_of("1 + 2 * 3") == 7);
  CHECK(value_of("(1 + 2) * 3") == 9);
  CHECK(value_of("10 - 4 - 3") == 3);
  CHECK(value_of("16 / 4 / 2") == 2);
  CHECK(value_of("2^3^2") == 512);
  CHECK(value_of("-2^2") == -4);
  CHECK(value_of("2^-1") == 0.5);
  CHECK(value_of("2 - -3") == 5);
  CHECK(value_of("1.5e2 * .5") == 75);
  CHECK(value_of("4/3 * pi * 2^3") == Approx(4 * std::numbers::pi / 3 * 8));
  CHECK(value_of("sqrt(16) + cbrt(27) + log(exp(2))") == Approx(9));
  CHECK(value_of("round(2.5) + floor(-0.5) + ceil(0.2)") == 3);
}

TEST_CASE("names take the values that are given for them, one for each time they stand") {
  const Expression expression("scene.size * n - scene.size");
  REQUIRE(expression.names().size() == 3);
  CHECK(expression.names()[0].text == "scene.size");
  CHECK(expression.names()[1].text == "n");
  CHECK(expression.names()[2].at == 17);
  CHECK(expression.value({5, 3, 5}) == 10);
}

TEST_CASE("what has no value is NaN or infinite, not an error of its own") {
  CHECK(std::isinf(value_of("1/0")));
  CHECK(std::isnan(value_of("sqrt(0 - 1)")));
}

TEST_CASE("errors name their place") {
  CHECK(refused_at("") == 0);
  CHECK(refused_at("1 +") == 3);
  CHECK(refused_at("1 + * 2") == 4);
  CHECK(refused_at("(1 + 2") == 6);
  CHECK(refused_at("1 2") == 2);
  CHECK(refused_at("2 * sin(1)") == 4);
  CHECK(refused_at("1e999") == 0);
  CHECK(refused_at("a # b") == 2);
  CHECK(refused_at(std::string(100000, '(')));
  CHECK(refused_at(std::string(100000, '-') + "1"));
  CHECK_FALSE(refused_at("a.b_c2 + 1"));
}

TEST_CASE("random text is an expression or refused, at a place inside it") {
  const std::vector<std::string> words = {"1", "2.5", "+",     "-",   "*", "/", "^", "(",
                                          ")", "pi",  "sqrt(", "a.b", " ", "e", "."};
  RandomStream random("expression", 0);
  int fine = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (std::uint64_t n = 1 + random.below(8); n > 0; --n)
      text += random.below(20) == 0 ? std::string(1, static_cast<char>(random.below(256)))
                                    : words[random.below(words.size())];
    INFO(text);
    try {
      const Expression expression(text);
      (void)expression.value(std::vector<double>(expression.names().size(), 2.0));
      ++fine;
    } catch (const ExpressionError& error) {
      REQUIRE(error.at <= text.size());
    }
  }
  CHECK(fine > 1000);
}

} // namespace tamp::test
