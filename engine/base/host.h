// Facts about the machine and this process that are recorded with every run: names, clocks, load, memory.
#pragma once

#include <sys/types.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace tamp {

/// What does not change while the machine is up.
struct HostFacts {
  std::string name;
  std::string cpu_model;    ///< From /proc/cpuinfo; the architecture's name where that states no model.
  std::string kernel;       ///< "Linux 6.1.0-18-amd64 x86_64".
  std::string boot_id;      ///< A new one after each start of the machine; empty if the kernel does not tell.
  int hardware_threads = 0; ///< Of the machine; those this process may use are usable_cores().
  std::uint64_t memory_bytes = 0;
};
HostFacts host_facts();

/// Numbers of the cores on which this process may run, ascending; throws Error if the system does not tell.
std::vector<int> usable_cores();

/// Runnable processes averaged over 1, 5 and 15 minutes; zeros if unknown.
std::array<double, 3> load_average();

/// The frequency governor of a core ("performance", "powersave"); empty if the kernel does not tell.
std::string frequency_governor(int core);

/// Time that a hypervisor has taken from these cores since the machine started, in seconds; only differences count.
double stolen_seconds(const std::vector<int>& cores);

/// How often this process has been taken off its cores against its will.
std::int64_t involuntary_switches();

/// A time as "2024-05-17T08:09:10.123456Z".
std::string to_utc(std::chrono::system_clock::time_point time);
std::string utc_now();

/// Seconds of a clock that never jumps; only differences have a meaning.
double steady_seconds();

/// CPU time (user and system) of this process, and of the calling thread, in seconds.
double process_cpu_seconds();
double thread_cpu_seconds();

/// Peak resident memory of a process (0: this one); 0 if there is none. This is VmHWM, which starts anew at exec, while
/// ru_maxrss of getrusage keeps what the process was before it.
std::uint64_t peak_rss_bytes(pid_t pid = 0);

} // namespace tamp
