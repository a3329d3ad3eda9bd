// What a child is to do between fork and exec, prepared in the parent, where allocation is still allowed.
#pragma once

#include "engine/base/process.h"
#include "engine/base/system.h"

#include <sched.h>
#include <sys/resource.h>
#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace tamp {

/// Everything the child needs, laid out before the fork, as it must not allocate afterwards. Not copied: argv and envp
/// point into it.
struct SpawnPlan {
  std::string program;
  std::vector<std::string> arguments;
  std::vector<std::string> variables;
  std::vector<char*> argv;
  std::vector<char*> envp;
  FileDescriptor input;
  FileDescriptor output;
  std::optional<cpu_set_t> cores;
  std::optional<rlimit> cpu;
  std::optional<rlimit> memory;
  rlim_t descriptors = 0;
  pid_t parent = -1;
};

/// Finds the program, merges the environment and opens the log. Throws Error if something is missing.
SpawnPlan make_spawn_plan(const ProcessRequest& request);

} // namespace tamp
