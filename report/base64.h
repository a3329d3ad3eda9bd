// Numbers as base64, the form in which a page can carry them.
#pragma once

#include <span>
#include <string>

namespace tamp {

/// The numbers as little-endian IEEE doubles in base64 (RFC 4648, with padding).
std::string base64_of(std::span<const double> numbers);

} // namespace tamp
