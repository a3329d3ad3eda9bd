// Edit distance by dynamic programming over three rows.
#include "campaigns/nearest.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace tamp {

namespace {

constexpr std::size_t kLongest = 100; ///< longer words are no misspelling of any key

std::string folded(std::string_view word) {
  std::string out;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i];
    if (const auto pair = word.substr(i, 2); pair == "\xC2\xB5" || pair == "\xCE\xBC") {
      out += 'u'; // both of Unicode's µ
      ++i;
    } else {
      out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c == '-' ? '_' : c;
    }
  }
  return out;
}

std::string_view last_step(std::string_view path) {
  return path.substr(path.rfind('/') + 1); // npos + 1 is 0
}

} // namespace

std::size_t edit_distance(std::string_view first, std::string_view second) {
  const std::string a = folded(first);
  const std::string b = folded(second);
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest(std::string_view word, std::span<const std::string> known) {
  if (word.empty() || word.size() > kLongest)
    return "";
  for (const std::string& candidate : known) {
    if (folded(last_step(candidate)) == folded(last_step(word)))
      return candidate;
  }
  std::string best;
  std::size_t least = kLongest;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && 2 * distance <= std::max(word.size(), candidate.size())) {
      best = candidate;
      least = distance;
    }
  }
  return best;
}

} // namespace tamp
