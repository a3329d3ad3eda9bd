// The one interface of all generators, and the table that lists them.
#pragma once

#include "engine/model/job.h"
#include "engine/model/packing.h"
#include "engine/model/record.h"

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// What a generator hands back. The packing counts only when the outcome is ok or did_not_converge; when it is
/// time_limited it is the state reached, or empty.
struct Generated {
  Packing packing;
  Outcome outcome = Outcome::ok;
  std::string reason;            ///< empty when ok
  Effects effects;               ///< what generate() tells of the method's rules, and what only the generator can know
  std::vector<Measure> measures; ///< what only the generator can know: attempts, failures, …
  std::map<std::string, std::string> programs = {}; ///< other programs that did the work, and their versions
  double programs_cpu_s = 0;                        ///< CPU time of those
};

/// Called now and then with the number of spheres placed so far.
using Progress = std::function<void(std::size_t)>;

/// What a generator is given. The key names the random streams and is the only source of randomness: the same job, key
/// and parent give the same bytes, however often the work was cut off and taken up again.
struct Request {
  const Job& job;
  std::string_view key;
  const Packing* parent = nullptr; ///< what to start from: set if and only if job.parent is
  Progress progress = {};
  std::filesystem::path checkpoint = {}; ///< file that a long job may keep its state in; empty: none
  std::filesystem::path folder = {};     ///< new folder for the scripts and logs of another program; empty: not kept
  double wall_s = 0; ///< seconds that the job has, after which it will be killed; 0: as many as it likes
};

/// One row: `generate(request)` makes the packing of a job.
struct Generator {
  MethodName name;
  Generated (*generate)(const Request& request);
};

std::span<const Generator> generators();

/// Runs the generator of the job's method. Throws InputError if the method needs a parent and has none, or the reverse.
Generated generate(const Request& request);

/// Numbers of the random streams of a generation job; each purpose has its own.
enum class Stream : std::uint64_t { radii = 1, positions = 2 };

} // namespace tamp
