// Collects mistakes and prints them as paragraphs.
#include "campaigns/mistakes.h"

#include "campaigns/json_document.h"
#include "campaigns/utf8.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

std::string Mistakes::written(std::size_t begin, std::size_t end) const {
  constexpr std::size_t longest = 60;
  std::string out;
  for (std::size_t i = begin; i < std::min(end, text_.size()); ++i) {
    const char c = text_[i];
    const bool blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (out.size() >= longest && !is_utf8_continuation(c))
      return out + "…";
    if (!blank)
      out += c;
    else if (!out.empty() && out.back() != ' ')
      out += ' ';
  }
  return out;
}

void Mistakes::throw_if_any() const {
  if (found_.empty())
    return;
  std::vector<Mistake> sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Mistake& a, const Mistake& b) { return a.place.offset < b.place.offset; });
  std::string message;
  for (const auto& [place, what, allowed, nearest] : sorted) {
    const auto [line, column] = line_column(text_, place.offset);
    const std::string_view where = place.pointer.empty() ? "the top level" : std::string_view(place.pointer);
    if (!message.empty())
      message += "\n\n";
    message += fmt::format("{}:{}:{}: at {}: {}", file_, line, column, where, what);
    if (!allowed.empty())
      message += "\n  allowed: " + allowed;
    if (!nearest.empty())
      message += "\n  nearest: " + nearest;
  }
  throw InputError(message);
}

} // namespace tamp
