// Small commands to run as children, and ways to see from outside what became of processes and descriptors.
#pragma once

#include "engine/base/host.h"
#include "engine/base/process.h"

#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace tamp {

inline ProcessRequest shell(const std::string& script) {
  return {.argv = {"/bin/sh", "-c", script}};
}

/// Hidden test cases of the running executable, by their tag, as a program of their own.
inline ProcessRequest own_test(const std::string& tag, const std::filesystem::path& path) {
  return {.argv = {std::filesystem::read_symlink("/proc/self/exe").string(), tag},
          .environment = {{"TAMP_TEST_PATH", path.string()}}};
}

inline std::size_t open_descriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    ++count;
  return count;
}

/// Whether this process has a child, be it running or a zombie.
inline bool has_children() {
  siginfo_t info;
  return ::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 || errno != ECHILD;
}

/// Dead, be it reaped or (where the system's first process does not reap) a zombie.
inline bool is_dead(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  if (!std::getline(file, text))
    return true;
  return text.substr(text.rfind(')') + 2, 1) == "Z";
}

template <class Condition>
bool eventually(Condition condition, double seconds = 10) {
  for (const double end = steady_seconds() + seconds; steady_seconds() < end;) {
    if (condition())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return condition();
}

/// The number before the word "end" in a file that another process is about to write; 0 if it never comes.
inline pid_t awaited_pid(const std::filesystem::path& path) {
  pid_t pid = 0;
  const bool came = eventually([&] {
    std::ifstream file(path);
    std::string end;
    return static_cast<bool>(file >> pid >> end) && end == "end";
  });
  return came ? pid : 0;
}

} // namespace tamp
