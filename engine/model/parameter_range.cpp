// What a parameter may be, in words, and whether it has been stated at all.
#include "engine/model/parameter.h"

#include <fmt/format.h>

#include <cmath>

namespace tamp {

std::string Range::words() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  std::string lower = fmt::format("{} {}", low_open ? "above" : "at least", low);
  std::string upper = fmt::format("{} {}", high_open ? "below" : "at most", high);
  if (has_low && has_high) {
    if (!low_open && !high_open)
      return fmt::format("from {} to {}", low, high);
    return lower + " and " + upper;
  }
  if (has_low)
    return lower;
  if (has_high)
    return upper;
  return "any number";
}

bool is_unstated(const JsonLeaf& leaf) {
  if (const auto* number = std::get_if<double>(&leaf))
    return std::isnan(*number);
  if (const auto* list = std::get_if<std::vector<double>>(&leaf))
    return list->empty();
  return false;
}

} // namespace tamp
