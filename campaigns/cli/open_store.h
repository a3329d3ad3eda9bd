// How commands open the store and what they take for already done.
#pragma once

#include "engine/base/file_lock.h"
#include "engine/model/plan.h"
#include "engine/schedule/agenda.h"
#include "store/store.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tamp::cli {

inline constexpr const char* kDefaultStore = "tamp-store";

/// Whether the folder holds a store.
bool store_exists(const std::string& folder);

/// An existing store; throws InputError if there is none.
Store open_for_reading(const std::string& folder);

/// The key of the only recorded job, of that kind if one is given, whose key begins so. Throws InputError unless there
/// is exactly one.
std::string whole_key(const Store& store, const std::string& beginning, std::optional<JobKind> kind = {});

/// The lock of those who run jobs, for as long as the object lives. Throws Error naming the process that has it.
FileLock hold(const std::filesystem::path& store);
inline FileLock hold(const Store& store) {
  return hold(store.folder());
}

/// Whether jobs that are recorded to have run out of time or memory count as done.
enum class Limited { done, open };

/// What the store remembers for good: outcomes that are final, of generations only while their packing is there too.
/// With Limited::open, a job that ran out of memory still counts as done unless `plans` allow it more than it had: it
/// would end in the same way. A snapshot, but for the packings; the store must outlive it.
Known known_to(const Store& store, Limited limited = Limited::done, std::span<const Plan> plans = {});

/// Reads all campaign files before anything else happens. Throws InputError with the mistakes of all of them, or if two
/// have one name.
std::vector<Plan> load_campaigns(const std::vector<std::string>& files);

} // namespace tamp::cli
