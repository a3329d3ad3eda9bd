// The processes of a run: which jobs it has started, and whether they live.
#pragma once

#include <fmt/format.h>
#include <sys/types.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace tamp::test {

/// The children of a run that have become `tamp job` (right after the fork they are still copies of the run).
inline std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> found;
  for (const auto& thread : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", parent))) {
    std::ifstream list(thread.path() / "children");
    for (pid_t pid = 0; list >> pid;) {
      std::ifstream command(fmt::format("/proc/{}/cmdline", pid));
      std::string word;
      std::getline(command, word, '\0');
      if (std::getline(command, word, '\0') && word == "job")
        found.push_back(pid);
    }
  }
  return found;
}

/// Whether a process runs; a zombie does not.
inline bool alive(pid_t pid) {
  std::ifstream stat(fmt::format("/proc/{}/stat", pid));
  std::string number;
  std::string name;
  std::string state;
  return stat >> number >> name >> state && state != "Z";
}

} // namespace tamp::test
