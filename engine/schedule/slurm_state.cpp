// Reads Slurm's columns and words.
#include "engine/schedule/slurm_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace tamp {

namespace {

constexpr std::array<std::string_view, 10> kOver = {"BOOT_FAIL", "CANCELLED",     "COMPLETED", "DEADLINE", "FAILED",
                                                    "NODE_FAIL", "OUT_OF_MEMORY", "PREEMPTED", "REVOKED",  "TIMEOUT"};

/// What Slurm and the kernel write into the output of an element that they kill for its use of memory.
constexpr std::array<std::string_view, 4> kOverMemory = {"exceeded memory limit", "Exceeded job memory limit",
                                                         "oom-kill event", "oom_kill event"};

std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

std::optional<int> whole(std::string_view digits) {
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() && !digits.empty() ? std::optional(number)
                                                                                         : std::nullopt;
}

/// "CANCELLED by 1000" → "CANCELLED".
std::string first_word(std::string_view text) {
  return std::string(take(text, ' '));
}

} // namespace

ElementStates parse_queue(std::string_view text) {
  ElementStates states;
  while (!text.empty()) {
    std::string_view line = take(text, '\n');
    const std::string name(take(line, '|'));
    const std::optional<int> element = whole(take(line, '|'));
    if (element && !line.empty())
      states[{name, *element}] = first_word(line);
  }
  return states;
}

ElementStates parse_accounting(std::string_view text) {
  ElementStates states;
  while (!text.empty()) {
    std::string_view line = take(text, '\n');
    const std::string name(take(line, '|'));
    std::string_view id = take(line, '|'); // JOB_ELEMENT
    take(id, '_');
    const std::optional<int> element = whole(id);
    if (element && !line.empty())
      states[{name, *element}] = first_word(line);
  }
  return states;
}

bool is_over(std::string_view state) {
  return std::find(kOver.begin(), kOver.end(), state) != kOver.end();
}

Verdict explain_absence(std::string_view state, const std::string& log_tail) {
  const bool over_memory = std::any_of(kOverMemory.begin(), kOverMemory.end(), [&](std::string_view words) {
    return log_tail.find(words) != std::string::npos;
  });
  const auto because = [&](Outcome outcome, const std::string& what) {
    const auto last = log_tail.find_last_not_of(" \n\t");
    if (last == std::string::npos)
      return Verdict{outcome, what};
    return Verdict{outcome, fmt::format("{}; its last words:\n{}", what, log_tail.substr(0, last + 1))};
  };
  if (over_memory || state == "OUT_OF_MEMORY")
    return because(Outcome::memory_limited, "killed by Slurm for its use of memory");
  if (state == "TIMEOUT" || state == "DEADLINE")
    return because(Outcome::time_limited, "ended by Slurm at the time limit of its element");
  if (state == "CANCELLED")
    return because(Outcome::cancelled, "cancelled in Slurm");
  if (state.empty())
    return because(Outcome::lost, "left no result, and Slurm knows it no more");
  return because(Outcome::lost, fmt::format("left no result; Slurm says {}", state));
}

} // namespace tamp
