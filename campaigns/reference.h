// The reference page of all parameters, written from the parameter tables.
#pragma once

#include <string>

namespace tamp {

/// Markdown page with path, type, unit, range, default, condition and meaning of every parameter:
/// campaigns/reference.md.
std::string reference_page();

} // namespace tamp
