// The one interface of all generators, and the table that lists them.
#pragma once

#include "engine/model/job.h"
#include "engine/model/packing.h"
#include "engine/model/record.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// What a generator hands back. The packing counts only when the outcome is ok or did_not_converge.
struct Generated {
  Packing packing;
  Outcome outcome = Outcome::ok;
  std::string reason; ///< empty when ok
  Effects effects;
  std::vector<Measure> measures; ///< what only the generator can know: attempts, failures, …
};

/// Called now and then with the number of spheres placed so far.
using Progress = std::function<void(std::size_t)>;

/// One row: `generate(job, key, progress)` makes the packing of a job. The key names the random streams and is the
/// only source of randomness: the same job and key give the same bytes.
struct Generator {
  MethodName name;
  Generated (*generate)(const Job& job, std::string_view key, const Progress& progress);
};

std::span<const Generator> generators();

/// Runs the generator of the job's method.
Generated generate(const Job& job, std::string_view key, const Progress& progress = {});

/// Numbers of the random streams of a generation job; each purpose has its own.
enum class Stream : std::uint64_t { radii = 1, positions = 2 };

} // namespace tamp
