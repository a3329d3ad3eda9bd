// A recursive-descent parser into postfix form, and the stack that evaluates it.
#include "campaigns/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace tamp {

namespace {

constexpr std::size_t kDeepest = 64; ///< nesting that no campaign needs

struct Function {
  std::string_view name;
  double (*call)(double);
};

constexpr std::array kFunctions = {
    Function{"sqrt", [](double x) { return std::sqrt(x); }},
    Function{"cbrt", [](double x) { return std::cbrt(x); }},
    Function{"log", [](double x) { return std::log(x); }},
    Function{"exp", [](double x) { return std::exp(x); }},
    Function{"round", [](double x) { return std::round(x); }},
    Function{"floor", [](double x) { return std::floor(x); }},
    Function{"ceil", [](double x) { return std::ceil(x); }},
};

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

} // namespace

/// Reads sums of products of powers, each as a function that appends its postfix form.
class ExpressionParser {
public:
  ExpressionParser(std::string_view text, Expression& out) : text_(text), out_(out) {}

  void parse() {
    sum();
    if (!at_end())
      fail("expected an operator or the end");
  }

private:
  using Step = Expression::Step;

  [[noreturn]] void fail(const std::string& expected) const {
    const std::string found = at_end() ? "the end" : fmt::format("'{}'", text_.substr(at_, 12));
    throw ExpressionError(fmt::format("{}, found {}", expected, found), at_);
  }
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }

  /// The next character that is not blank; 0 at the end.
  char here() {
    while (!at_end() && (text_[at_] == ' ' || text_[at_] == '\t'))
      ++at_;
    return at_end() ? '\0' : text_[at_];
  }

  bool take(char c) {
    if (here() != c)
      return false;
    ++at_;
    return true;
  }

  void emit(Step step) { out_.postfix_.push_back({step}); }

  void sum() {
    product();
    for (;;) {
      if (take('+')) {
        product();
        emit(Step::add);
      } else if (take('-')) {
        product();
        emit(Step::subtract);
      } else {
        return;
      }
    }
  }

  void product() {
    signed_power();
    for (;;) {
      if (take('*')) {
        signed_power();
        emit(Step::multiply);
      } else if (take('/')) {
        signed_power();
        emit(Step::divide);
      } else {
        return;
      }
    }
  }

  /// All recursion passes through here, so here it is bounded.
  void signed_power() {
    if (++depth_ > kDeepest)
      throw ExpressionError(fmt::format("the expression is nested more than {} deep", kDeepest), at_);
    if (take('-')) {
      signed_power();
      emit(Step::negate);
    } else if (take('+')) {
      signed_power();
    } else {
      atom();
      if (take('^')) {
        signed_power();
        emit(Step::power);
      }
    }
    --depth_;
  }

  void atom() {
    const char c = here();
    if (take('(')) {
      sum();
      if (!take(')'))
        fail("expected ')'");
    } else if (is_digit(c) || c == '.') {
      number();
    } else if (is_letter(c)) {
      word();
    } else {
      fail("expected a number, a name or '('");
    }
  }

  void number() {
    double number = 0;
    const auto [stop, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
    if (error != std::errc{})
      fail("expected a number that can be held");
    at_ = static_cast<std::size_t>(stop - text_.data());
    out_.postfix_.push_back({Step::number, number});
  }

  void word() {
    const std::size_t begin = at_;
    while (!at_end() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '.'))
      ++at_;
    const std::string_view name = text_.substr(begin, at_ - begin);
    if (take('(')) {
      const auto* function =
          std::find_if(kFunctions.begin(), kFunctions.end(), [&](const Function& f) { return f.name == name; });
      if (function == kFunctions.end())
        throw ExpressionError(
            fmt::format("there is no function \"{}\"; known: {}", name, fmt::join(Expression::functions(), ", ")),
            begin);
      sum();
      if (!take(')'))
        fail("expected ')'");
      out_.postfix_.push_back({Step::call, 0, 0, function->call});
    } else if (name == "pi") {
      out_.postfix_.push_back({Step::number, std::numbers::pi});
    } else {
      out_.postfix_.push_back({Step::name, 0, out_.names_.size()});
      out_.names_.push_back({std::string(name), begin});
    }
  }

  std::string_view text_;
  Expression& out_;
  std::size_t at_ = 0;
  std::size_t depth_ = 0;
};

Expression::Expression(std::string_view text) {
  ExpressionParser(text, *this).parse();
}

double Expression::value(const std::vector<double>& values) const {
  std::vector<double> stack;
  const auto pop = [&] {
    const double top = stack.back();
    stack.pop_back();
    return top;
  };
  const auto join = [&](auto operation) {
    const double right = pop();
    stack.back() = operation(stack.back(), right);
  };
  for (const Operation& operation : postfix_) {
    switch (operation.step) {
    case Step::number:
      stack.push_back(operation.number);
      break;
    case Step::name:
      stack.push_back(values.at(operation.index));
      break;
    case Step::add:
      join([](double a, double b) { return a + b; });
      break;
    case Step::subtract:
      join([](double a, double b) { return a - b; });
      break;
    case Step::multiply:
      join([](double a, double b) { return a * b; });
      break;
    case Step::divide:
      join([](double a, double b) { return a / b; });
      break;
    case Step::power:
      join([](double a, double b) { return std::pow(a, b); });
      break;
    case Step::negate:
      stack.back() = -stack.back();
      break;
    case Step::call:
      stack.back() = operation.call(stack.back());
      break;
    }
  }
  return stack.back();
}

std::vector<std::string> Expression::functions() {
  std::vector<std::string> names;
  for (const Function& function : kFunctions)
    names.emplace_back(function.name);
  return names;
}

} // namespace tamp
