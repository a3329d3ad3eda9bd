// Words for jobs and counts that several commands print.
#pragma once

#include "engine/schedule/agenda.h"

#include <cstddef>
#include <map>
#include <string>

namespace tamp::cli {

/// "drop-and-roll, scene/size = 60, replicate 3": a generation job as its campaign calls it.
std::string job_name(const std::string& label, const std::map<std::string, std::string>& point, std::int64_t replicate);

/// The first digits of a key: enough to find it.
std::string short_key(const std::string& key);

std::size_t total(const OutcomeCounts& counts);

/// "30 ok, 2 failed": the outcomes that occur; "none" without any.
std::string in_words(const OutcomeCounts& counts);

} // namespace tamp::cli
