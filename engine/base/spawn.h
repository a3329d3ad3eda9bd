// Forks a child that dies with its parent: the lower half of process.h, for process.cpp alone.
#pragma once

#include "engine/base/process.h"
#include "engine/base/system.h"

#include <sys/types.h>

#include <chrono>
#include <cstdint>

namespace tamp {

/// A child whose program has been loaded.
struct SpawnedChild {
  pid_t pid = -1;
  FileDescriptor pidfd;
  std::chrono::steady_clock::time_point start;
  /// What the kernel already counted as the child's peak when it was still a copy of this process.
  std::uint64_t inherited_rss_bytes = 0;
};

/// Starts the request's program in a process group of its own. Throws Error; then no child is left behind.
SpawnedChild spawn(const ProcessRequest& request);

} // namespace tamp
