// Words for jobs and counts that several commands print.
#pragma once

#include "engine/schedule/agenda.h"

#include <cstddef>
#include <string>

namespace tamp::cli {

/// The first digits of a key: enough to find it.
std::string short_key(const std::string& key);

std::size_t total(const OutcomeCounts& counts);

/// "30 ok, 2 failed": the outcomes that occur; "none" without any.
std::string in_words(const OutcomeCounts& counts);

} // namespace tamp::cli
