// Content hashing: the identity of jobs and packings.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace tamp {

/// SHA-256 of the bytes (FIPS 180-4, through OpenSSL).
std::array<std::uint8_t, 32> sha256(std::string_view bytes);

/// The same as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

} // namespace tamp
