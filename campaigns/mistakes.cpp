// Collects mistakes and prints them as paragraphs.
#include "campaigns/mistakes.h"

#include "campaigns/json_document.h"
#include "campaigns/utf8.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

std::size_t Mistakes::add_source(std::string file, std::string_view text) {
  const Source& last = sources_.back();
  const std::size_t begin = last.begin + last.text.size() + 1;
  sources_.push_back({std::move(file), text, begin});
  return begin;
}

const Mistakes::Source& Mistakes::source_of(std::size_t offset) const {
  std::size_t i = sources_.size() - 1;
  while (offset < sources_[i].begin)
    --i; // the first begins at 0
  return sources_[i];
}

std::string Mistakes::written(std::size_t begin, std::size_t end) const {
  const Source& source = source_of(begin);
  const std::string_view text = source.text;
  begin -= source.begin;
  end -= source.begin;
  constexpr std::size_t longest = 60;
  std::string out;
  for (std::size_t i = begin; i < std::min(end, text.size()); ++i) {
    const char c = text[i];
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
    const Source& source = source_of(place.offset);
    const auto [line, column] = line_column(source.text, place.offset - source.begin);
    const std::string_view where = place.pointer.empty() ? "the top level" : std::string_view(place.pointer);
    if (!message.empty())
      message += "\n\n";
    message += fmt::format("{}:{}:{}: at {}: {}", source.file, line, column, where, what);
    if (!allowed.empty())
      message += "\n  allowed: " + allowed;
    if (!nearest.empty())
      message += "\n  nearest: " + nearest;
  }
  throw InputError(message);
}

} // namespace tamp
