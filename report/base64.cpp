// Writes base64.
#include "report/base64.h"

#include <bit>
#include <cstdint>
#include <string_view>

namespace tamp {

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Byte i of the numbers laid one after the other, the lowest byte of each first.
std::uint32_t byte_of(std::span<const double> numbers, std::size_t i) {
  const auto bits = std::bit_cast<std::uint64_t>(numbers[i / 8]);
  return static_cast<std::uint32_t>(bits >> (8 * (i % 8)) & 0xFFU);
}

} // namespace

std::string base64_of(std::span<const double> numbers) {
  const std::size_t bytes = numbers.size() * 8;
  std::string out;
  out.reserve((bytes + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes; i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      group = group << 8U | (k < bytes ? byte_of(numbers, k) : 0U);
    for (std::size_t digit = 0; digit < 4; ++digit)
      out += i + digit > bytes ? '=' : kDigits[group >> (18 - 6 * digit) & 63U];
  }
  return out;
}

} // namespace tamp
