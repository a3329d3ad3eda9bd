// The first line of a reason, for lists of one line a job.
#pragma once

#include <string>

namespace tamp::cli {

inline std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

} // namespace tamp::cli
