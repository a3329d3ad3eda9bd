// Arithmetic in campaign files: an expression over numbers and named values, parsed once, evaluated at each point.
#pragma once

#include "engine/base/error.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// Text that is no expression: what was expected, at which byte.
struct ExpressionError : InputError {
  ExpressionError(const std::string& message, std::size_t where) : InputError(message), at(where) {}
  std::size_t at;
};

/// + - * / ^ (from the right, before a sign: -2^2 = -4), parentheses, pi, functions of one number (functions()), and
/// names of letters, digits, '_' and '.' that the caller gives values.
class Expression {
public:
  /// Throws ExpressionError; deep nesting is refused, so that hostile text cannot exhaust the stack.
  explicit Expression(std::string_view text);

  struct Name {
    std::string text;
    std::size_t at; ///< byte of its first letter
  };
  /// The names in the order of the text; one that stands twice is there twice.
  [[nodiscard]] const std::vector<Name>& names() const { return names_; }

  /// The value, `values[i]` being that of names()[i]. NaN or infinite where arithmetic makes it so (1/0, sqrt(-1)).
  [[nodiscard]] double value(const std::vector<double>& values) const;

  /// "sqrt", "cbrt", …
  static std::vector<std::string> functions();

private:
  friend class ExpressionParser;
  enum class Step { number, name, add, subtract, multiply, divide, power, negate, call };
  /// One step of the postfix form.
  struct Operation {
    Step step;
    double number = 0;     ///< of a number
    std::size_t index = 0; ///< of a name
    double (*call)(double) = nullptr;
  };
  std::vector<Operation> postfix_;
  std::vector<Name> names_;
};

} // namespace tamp
