// Records as rows of the tables jobs, attempts, measures, effects, builds and hosts.
#pragma once

#include "engine/model/record.h"
#include "store/query.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace tamp {

/// Throws Error for a record that no row can hold: a number that is not finite, two measures of one name.
void check_storable(const Record& record);

/// Adds the record as a further attempt, inside the caller's transaction. False, and nothing added, if its key has an
/// ok attempt, or if the latest attempt is this very run (same start and end) taken in before.
bool insert_record(Statements& statements, const Record& record);

/// The outcome of the latest attempt.
std::optional<Outcome> latest_outcome(Statements& statements, std::string_view key);

/// The attempts at a key, oldest first; or only the latest.
std::vector<Record> select_records(Statements& statements, std::string_view key, bool latest_only);

} // namespace tamp
