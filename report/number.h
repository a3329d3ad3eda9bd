// Numbers as digits: how many digits a spread leaves, rounding to them, thousands. No marks of any output format.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tamp {

/// Digits after the point that leave two significant digits of a spread above 0; negative: tens, hundreds, …
/// The spread is rounded first, so 0.0996 (which rounds to 0.10) leaves 2.
int decimals_of_spread(double spread);

/// Digits after the point that leave `digits` significant digits of a value; 0 for the value 0.
int decimals_of_significant(double value, int digits);

/// A finite value rounded to so many digits after the point (negative: to tens, …), without a negative zero.
std::string fixed(double value, int decimals);

/// Mantissa and exponent of a value with two significant digits: 2.13e-14 → "2.1", -14. The value 0 has no exponent.
struct Scientific {
  std::string mantissa;
  std::optional<int> exponent;
};
Scientific scientific(double value);

/// A share from 0 to 1, cut (not rounded) to six digits after the point: "1" means each and every one.
std::string share(double value);

/// Puts the separator between groups of three digits before the point, if there are more than four of them.
std::string grouped(std::string_view number, std::string_view separator);

/// A time in the unit in which it reads best: up to 2 minutes in s, 2 hours in min, a day in h, above in d.
struct TimeUnit {
  std::string_view name;
  double seconds;
};
TimeUnit time_unit(double seconds);

} // namespace tamp
