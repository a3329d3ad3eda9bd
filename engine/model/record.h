// Record: one remembered run of a job — what it was, how it ended, what it found, and where all that came from.
#pragma once

#include "engine/model/enum_names.h"
#include "engine/model/outcome.h"

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace tamp {

/// One measured number. Units are "1" for pure numbers, a length unit, "s", "B".
struct Measure {
  std::string name;
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string unit = "1";
};

/// Which physical effects a run simulated and which it left out, with the reason.
struct Effects {
  struct LeftOut {
    std::string effect;
    std::string why;
  };
  std::vector<std::string> simulated;
  std::vector<LeftOut> left_out;
};

/// exclusive: alone on the machine, on one pinned thread (the paper's protocol). shared: other jobs ran beside it.
enum class TimingMode { shared, exclusive };
template <>
struct EnumNames<TimingMode> {
  static constexpr std::array<std::string_view, 2> value{"shared", "exclusive"};
};

/// What went on on the machine while a job was timed.
struct Conditions {
  double load = 0;           ///< processes that could run, averaged over the minute before
  std::int64_t switches = 0; ///< times that the job was taken off its core against its will
  double steal_s = 0;        ///< what a hypervisor took from its core (from all cores, if it had more than one)
  std::string governor;      ///< of the frequency of its core; empty if there is none
  std::string disturbed;     ///< why the time does not count; empty if it does
};

/// One of several runs of a generator that were timed in turn.
struct TimeSample {
  double wall_s = 0;
  double cpu_s = 0;
  double steal_s = 0;        ///< as in Conditions
  std::int64_t switches = 0; ///< as in Conditions
  std::string disturbed;     ///< as in Conditions
};

/// `wall_s` and `cpu_s` are of the generator or metric alone (the medians of `samples`, if there are any); `process_*`
/// are of the whole child process.
struct Timing {
  TimingMode mode = TimingMode::shared;
  double wall_s = 0;
  double cpu_s = 0;
  double process_wall_s = 0;
  double process_cpu_s = 0;
  std::uint64_t peak_rss_bytes = 0;
  Conditions conditions = {};
  std::vector<TimeSample> samples = {}; ///< empty if the job ran once, as most do

  /// Whether the time may stand beside others of this mode in statistics.
  [[nodiscard]] bool counts_as(TimingMode wanted) const { return mode == wanted && conditions.disturbed.empty(); }
};

/// What a job was allowed to use; 0: no bound, or it is not known.
struct Limits {
  double wall_s = 0;
  double cpu_s = 0;
  std::int64_t memory_mb = 0;
};

/// Where a record came from: enough to run it again and to doubt it.
struct Provenance {
  std::string commit;
  bool dirty = false;
  std::string compiler;
  std::string flags;
  std::map<std::string, std::string> libraries;
  std::string host;
  std::string boot_id;  ///< of the host's present start, by which a process number has a meaning
  std::int64_t pid = 0; ///< of the process that ran the job, or that found it dead
  std::string cpu_model;
  std::string kernel;
  std::int64_t hardware_threads = 0;
  std::int64_t threads = 1; ///< threads this job was given
  std::string start_utc;    ///< ISO 8601, UTC
  std::string end_utc;
};

enum class JobKind { generation, metric };
template <>
struct EnumNames<JobKind> {
  static constexpr std::array<std::string_view, 2> value{"generation", "metric"};
};

struct Record {
  std::string key;
  JobKind kind = JobKind::generation;
  std::string name;          ///< method or metric
  std::int64_t revision = 0; ///< of the method or metric
  std::string canonical;     ///< canonical JSON whose SHA-256 is the key
  std::string parent;        ///< key of the job whose packing this one starts from or measures; may be empty
  Outcome outcome = Outcome::failed;
  std::string reason; ///< empty when ok
  Effects effects;    ///< generation only
  std::vector<Measure> measures;
  Timing timing;
  Limits limits; ///< generation only
  Provenance provenance;
  std::string packing_file; ///< relative to the store; generation jobs that have a packing
  std::string packing_sha256;
};

} // namespace tamp
