// What Slurm says of the elements of job arrays, and what that means for a job that left no result.
#pragma once

#include "engine/schedule/process_executor.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace tamp {

/// State of each element, by the name of its array and its number: {"tamp-x-0", 3} → "RUNNING".
using ElementStates = std::map<std::pair<std::string, int>, std::string>;

/// The format that parse_queue() reads, for squeue --format.
inline constexpr const char* kQueueFormat = "%j|%K|%T";

/// Lines of squeue in that format; others (headers, jobs without elements) are passed over.
ElementStates parse_queue(std::string_view text);

/// Lines of sacct --parsable2 with the columns JobName,JobID,State.
ElementStates parse_accounting(std::string_view text);

/// Whether an element in this state will not run any more. An unknown word counts as alive: waiting does no harm.
bool is_over(std::string_view state);

/// Why a job that its element had begun left no result. `state`: Slurm's last word, empty if it knows the element no
/// more; `log_tail`: the end of the element's output, which alone tells a kill for memory from kill -9.
Verdict explain_absence(std::string_view state, const std::string& log_tail);

} // namespace tamp
