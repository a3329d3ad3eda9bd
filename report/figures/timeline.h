// A timeline of runs as SVG: which job ran when, beside which others, on which machine.
#pragma once

#include "engine/model/method.h"
#include "engine/model/record.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// One run of a job.
struct TimelineBar {
  std::string host;
  double start_s = 0;               ///< of some common clock
  double end_s = 0;                 ///< not before the start
  std::optional<MethodName> method; ///< none: a metric
  bool ok = true;
  std::string what; ///< shown where the mouse rests
};

/// Seconds since 1970 of "2024-05-17T08:09:10.123456Z"; nothing for other text.
std::optional<double> seconds_of_utc(std::string_view utc);

/// The bar of a record; nothing for one whose times are not of a process (lost on a cluster) or are not known.
std::optional<TimelineBar> timeline_bar(const Record& record, std::string what);

/// A lane for each bar, counted from 0 on each host: the lowest that is free when the bar starts, bars taken by their
/// starts. No two bars of a lane overlap, and a host has as many lanes as it ever had bars at once. Records do not know
/// on which core a job ran, so a lane is a place among the jobs at once, not a core.
std::vector<std::size_t> timeline_lanes(std::span<const TimelineBar> bars);

/// The timeline: lanes from the top, grouped by host; a colour for each method, as in all figures, grey for metrics;
/// hollow what did not end ok. Pauses between runs are cut short. Bars too thin to see are drawn together with their
/// neighbours, in the look of the longest of them, so the size does not grow with the number of jobs. The same bars
/// give the same bytes. Throws InputError without bars.
std::string timeline_svg(std::span<const TimelineBar> bars, std::string_view title);

} // namespace tamp
