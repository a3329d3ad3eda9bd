// The one door through which results reach the disk: whole or not at all, whatever fails and whenever the power goes.
#pragma once

#include "engine/base/file_lock.h" // Part of the same door: who may write.
#include "engine/base/system.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// Makes `path` hold exactly `bytes`: written to a temporary name beside it, synced, renamed, and the folder synced.
/// Throws Error (path, errno). A failure up to the rename leaves the old file as it was and removes the temporary; if
/// only the sync of the folder fails, the new file is in place and whole, but might not outlive a loss of power.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Makes a file that a library has written and closed real under its final name: sync, rename, sync of the folder.
/// Both names must be on one file system (use temporary_name). Errors as in write_atomically; the temporary is removed.
void publish(const std::filesystem::path& temporary, const std::filesystem::path& final_path);

/// The bytes of a file; throws Error if it cannot be read.
std::string read_file(const std::filesystem::path& path);

/// A name beside `path` that nobody else uses: ".NAME.HOST.PID.START.COUNT.tamp-tmp", START being the time at which
/// this process started (ticks since boot), so that a process number used again is not mistaken for the maker.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// The temporaries in `folder` (not below it) whose maker runs no more; they can be removed. Those made on another host
/// count once they have not been written for a day. Empty if there is no such folder.
std::vector<std::filesystem::path> stale_temporaries(const std::filesystem::path& folder);

/// Removes them; returns how many. One that cannot be removed, or that somebody else removed, is passed over.
std::size_t remove_stale_temporaries(const std::filesystem::path& folder);

} // namespace tamp
