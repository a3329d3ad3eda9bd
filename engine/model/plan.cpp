// Names jobs as campaigns do.
#include "engine/model/plan.h"

#include <fmt/format.h>

namespace tamp {

std::string job_name(const std::string& label, const std::map<std::string, std::string>& point,
                     std::int64_t replicate) {
  std::string text = label;
  for (const auto& [path, value] : point)
    text += fmt::format(", {} = {}", path, value);
  return text + fmt::format(", replicate {}", replicate);
}

} // namespace tamp
