// Reads the facts from /proc and the system clocks.
#include "engine/base/host.h"

#include "engine/base/system.h"

#include <sched.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

namespace tamp {
namespace {

/// The text after "key<blanks>:" in a file of such lines, trimmed at its start; empty if there is none.
std::string value_in(const std::string& path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, key.size(), key) != 0)
      continue;
    const auto colon = line.find_first_not_of(" \t", key.size());
    if (colon == std::string::npos || line[colon] != ':')
      continue;
    const auto start = line.find_first_not_of(" \t", colon + 1);
    return start == std::string::npos ? std::string() : line.substr(start);
  }
  return {};
}

double seconds_of(clockid_t clock) {
  timespec time{};
  if (::clock_gettime(clock, &time) != 0)
    throw system_error("cannot read a clock", errno);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

HostFacts host_facts() {
  utsname names{};
  if (::uname(&names) != 0)
    throw system_error("cannot read the name of the host", errno);
  HostFacts facts;
  facts.name = names.nodename;
  facts.cpu_model = value_in("/proc/cpuinfo", "model name");
  if (facts.cpu_model.empty())
    facts.cpu_model = names.machine;
  facts.kernel = std::string(names.sysname) + ' ' + names.release + ' ' + names.machine;
  std::ifstream boot_id("/proc/sys/kernel/random/boot_id");
  std::getline(boot_id, facts.boot_id);
  facts.hardware_threads = static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN));
  facts.memory_bytes =
      static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return facts;
}

std::vector<int> usable_cores() {
  cpu_set_t set;
  if (::sched_getaffinity(::getpid(), sizeof set, &set) != 0)
    throw system_error("cannot read the usable cores", errno);
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<std::size_t>(core), &set))
      cores.push_back(core);
  return cores;
}

std::array<double, 3> load_average() {
  std::array<double, 3> load{};
  if (::getloadavg(load.data(), 3) != 3)
    return {};
  return load;
}

std::string frequency_governor(int core) {
  std::ifstream file("/sys/devices/system/cpu/cpu" + std::to_string(core) + "/cpufreq/scaling_governor");
  std::string name;
  std::getline(file, name);
  return name;
}

double stolen_seconds(const std::vector<int>& cores) {
  constexpr int fields_before_steal = 7; // user nice system idle iowait irq softirq
  double ticks = 0;
  for (const int core : cores) {
    std::ifstream file("/proc/stat");
    const std::string name = "cpu" + std::to_string(core);
    for (std::string word; file >> word;) {
      if (word != name) {
        std::getline(file, word);
        continue;
      }
      double field = 0;
      for (int i = 0; i <= fields_before_steal; ++i)
        file >> field;
      ticks += field;
      break;
    }
  }
  return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

std::int64_t involuntary_switches() {
  rusage usage{};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? usage.ru_nivcsw : 0;
}

std::string to_utc(std::chrono::system_clock::time_point time) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(time);
  const auto micro = std::chrono::duration_cast<std::chrono::microseconds>(time - whole).count();
  const std::time_t seconds = std::chrono::system_clock::to_time_t(whole);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::array<char, 16> fraction{};
  std::snprintf(fraction.data(), fraction.size(), ".%06dZ", static_cast<int>(micro));
  return std::string(date.data()) + fraction.data();
}

std::string utc_now() {
  return to_utc(std::chrono::system_clock::now());
}

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double process_cpu_seconds() {
  return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

double thread_cpu_seconds() {
  return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

std::uint64_t peak_rss_bytes(pid_t pid) {
  const std::string process = pid == 0 ? "self" : std::to_string(pid);
  const std::string value = value_in("/proc/" + process + "/status", "VmHWM"); // "  1234 kB"
  return value.empty() ? 0 : std::strtoull(value.c_str(), nullptr, 10) * 1024;
}

} // namespace tamp
