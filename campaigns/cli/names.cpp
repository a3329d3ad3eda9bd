// Words for jobs and counts.
#include "campaigns/cli/names.h"

#include <fmt/format.h>

#include <numeric>

namespace tamp::cli {

std::string short_key(const std::string& key) {
  constexpr std::size_t kDigits = 12;
  return key.substr(0, kDigits);
}

std::size_t total(const OutcomeCounts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

std::string in_words(const OutcomeCounts& counts) {
  std::string text;
  for (std::size_t o = 0; o < counts.size(); ++o) {
    if (counts[o] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[o], EnumNames<Outcome>::value[o]);
  }
  return text.empty() ? "none" : text;
}

} // namespace tamp::cli
