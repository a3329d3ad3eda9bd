// Looks up the program, opens the streams, and works out limits, cores and environment of a child.
#include "engine/base/spawn_plan.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace tamp {
namespace {

/// Opens a descriptor above the standard three, so that dup2 in the child can neither overwrite nor be a no-op on it.
FileDescriptor open_above_standard(const std::filesystem::path& path, int flags) {
  FileDescriptor first(::open(path.c_str(), flags | O_CLOEXEC | O_NOCTTY, 0666));
  if (!first)
    throw system_error("cannot open " + path.string(), errno);
  if (first.get() > STDERR_FILENO)
    return first;
  FileDescriptor second(::fcntl(first.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
  if (!second)
    throw system_error("cannot duplicate the descriptor of " + path.string(), errno);
  return second;
}

/// The file that execvp would run. Searched here because execvp is not async-signal-safe.
std::string find_program(const std::string& name) {
  if (name.find('/') != std::string::npos)
    return name;
  const char* path = std::getenv("PATH");
  std::string_view folders = path != nullptr ? path : "/usr/bin:/bin";
  for (;;) {
    const auto colon = folders.find(':');
    std::string folder(folders.substr(0, colon));
    if (folder.empty())
      folder = ".";
    std::string candidate = folder + '/' + name;
    if (!name.empty() && ::access(candidate.c_str(), X_OK) == 0)
      return candidate;
    if (colon == std::string_view::npos)
      break;
    folders.remove_prefix(colon + 1);
  }
  throw system_error("cannot find the program '" + name + "' in PATH", ENOENT);
}

std::vector<std::string> merged_environment(const ProcessRequest& request) {
  std::vector<std::string> variables;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const auto name = text.substr(0, text.find('='));
    const auto replaces = [&](const auto& addition) { return addition.first == name; };
    if (std::none_of(request.environment.begin(), request.environment.end(), replaces))
      variables.emplace_back(text);
  }
  for (const auto& [name, value] : request.environment)
    variables.push_back(name + '=' + value);
  return variables;
}

/// A limit no higher than the hard one already in force, which an ordinary user may not raise.
rlimit capped_limit(int resource, rlim_t soft, rlim_t hard) {
  rlimit present{};
  ::getrlimit(static_cast<__rlimit_resource>(resource), &present);
  return {std::min(soft, present.rlim_max), std::min(hard, present.rlim_max)};
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (auto& text : texts)
    result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

} // namespace

SpawnPlan make_spawn_plan(const ProcessRequest& request) {
  if (request.argv.empty())
    throw Error("cannot start a process without a program");
  SpawnPlan plan;
  plan.program = find_program(request.argv.front());
  plan.arguments = request.argv;
  plan.variables = merged_environment(request);
  plan.argv = pointers(plan.arguments);
  plan.envp = pointers(plan.variables);
  plan.input = open_above_standard("/dev/null", O_RDONLY);
  plan.output = request.log.empty() ? open_above_standard("/dev/null", O_WRONLY)
                                    : open_above_standard(request.log, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND);
  if (request.core) {
    if (*request.core < 0 || *request.core >= CPU_SETSIZE)
      throw Error("cannot pin a process to core " + std::to_string(*request.core));
    plan.cores.emplace();
    CPU_ZERO(&*plan.cores);
    CPU_SET(static_cast<std::size_t>(*request.core), &*plan.cores);
  }
  if (request.limits.cpu_s > 0) {
    // SIGXCPU at the soft limit; SIGKILL follows at the hard one for a child that ignores it.
    const auto seconds = static_cast<rlim_t>(std::ceil(std::min(request.limits.cpu_s, 1e9)));
    const auto grace = static_cast<rlim_t>(std::ceil(std::clamp(request.grace_s, 1.0, 1e9)));
    plan.cpu = capped_limit(RLIMIT_CPU, seconds, seconds + grace);
  }
  if (const auto bytes = request.limits.memory_bytes; bytes > 0)
    plan.memory = capped_limit(RLIMIT_AS, bytes, bytes);
  rlimit descriptors{};
  ::getrlimit(RLIMIT_NOFILE, &descriptors);
  plan.descriptors = descriptors.rlim_cur;
  plan.parent = ::getpid();
  return plan;
}

} // namespace tamp
