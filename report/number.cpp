// Rounding and digits of numbers.
#include "report/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace tamp {

namespace {

/// Exponent of a value after rounding to `digits` significant digits, as the formatted text says it: log10 and floor
/// would be off by one beside powers of ten.
int decimal_exponent(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  return std::atoi(text.c_str() + text.find('e') + 1);
}

} // namespace

int decimals_of_spread(double spread) {
  return 1 - decimal_exponent(spread, 2);
}

int decimals_of_significant(double value, int digits) {
  return value == 0 ? 0 : digits - 1 - decimal_exponent(value, digits);
}

std::string fixed(double value, int decimals) {
  if (decimals < 0) {
    const double step = std::pow(10.0, -decimals);
    value = std::round(value / step) * step;
  }
  std::string text = fmt::format("{:.{}f}", value, std::max(decimals, 0));
  if (text.front() == '-' && text.find_first_of("123456789") == std::string::npos)
    text.erase(0, 1);
  return text;
}

Scientific scientific(double value) {
  if (value == 0)
    return {"0", std::nullopt};
  const std::string text = fmt::format("{:.1e}", value);
  const auto e = text.find('e');
  return {text.substr(0, e), std::atoi(text.c_str() + e + 1)};
}

std::string share(double value) {
  constexpr double kSteps = 1e6;
  std::string text = fixed(std::floor(value * kSteps) / kSteps, 6);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.')
    text.pop_back();
  return text;
}

std::string grouped(std::string_view number, std::string_view separator) {
  const std::size_t start = !number.empty() && (number[0] == '-' || number[0] == '+') ? 1 : 0;
  const std::size_t end = std::min(number.find('.'), number.size());
  std::string text;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (end - start > 4 && i > start && i < end && (end - i) % 3 == 0)
      text += separator;
    text += number[i];
  }
  return text;
}

TimeUnit time_unit(double seconds) {
  constexpr std::array units = {TimeUnit{"s", 1}, TimeUnit{"min", 60}, TimeUnit{"h", 3600}};
  constexpr std::array limits = {120.0, 7200.0, 86400.0};
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (seconds < limits[i])
      return units[i];
  }
  return {"d", 86400};
}

} // namespace tamp
