// A cell in words and marks that Markdown and HTML share: Unicode signs, and <sup> for powers of ten.
#pragma once

#include "report/table.h"

#include <functional>
#include <string>
#include <string_view>

namespace tamp {

/// "0.6312 ± 0.0021", "2.1·10<sup>−14</sup>", "(0.644)", "–" for an empty cell; a word goes through `text`.
std::string marked_cell(const Cell& cell, const std::function<std::string(std::string_view)>& text);

} // namespace tamp
