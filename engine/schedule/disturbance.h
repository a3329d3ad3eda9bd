// Judges whether a time that was taken alone on the machine was disturbed by something else.
#pragma once

#include "engine/model/record.h"

#include <string>

namespace tamp {

/// Share of the wall time, and seconds, that a job on a core of its own may wait without it being laid to others: for
/// the disk, for the kernel's own work.
inline constexpr double kWaitedShare = 0.03;
inline constexpr double kWaitedLeast_s = 0.01;
/// Share of the wall time that a hypervisor may have taken.
inline constexpr double kStolenShare = 0.01;

/// Why a time that was taken alone, in seconds, does not count: its core did something else meanwhile. Empty if it
/// does.
std::string disturbance(double wall_s, double cpu_s, double steal_s);

/// Marks what was disturbed of an exclusive time. Of several samples the medians of those that count become the time;
/// if none counts, of all, and the time is marked.
void settle_time(Timing& timing);

} // namespace tamp
