// Job: one unit of work, named by its content.
#pragma once

#include "engine/model/method.h"
#include "engine/model/metric.h"
#include "engine/model/scene.h"

#include <cstdint>
#include <string>

namespace tamp {

/// A generation job: one packing of a scene by a method. `seed` chooses the family of random streams,
/// `replicate` counts inside it; `parent` is the key of the packing a method starts from, or empty.
struct Job {
  Scene scene;
  Method method;
  std::int64_t seed = 1;
  std::int64_t replicate = 0;
  std::string parent;
};

/// RFC 8785 text of everything that decides the job's result: kind, scene, method with its own parameters and its
/// revision, seed, replicate, parent. Limits, labels and the machine are not part of it. The scene must be completed.
std::string canonical(const Job& job);

/// SHA-256 of canonical(job), 64 hexadecimal digits: names the random streams, the packing file and the record.
std::string job_key(const Job& job);

/// The same for one metric on the packing of a generation job.
std::string canonical(const Metric& metric, const std::string& packing_key);
std::string metric_key(const Metric& metric, const std::string& packing_key);

} // namespace tamp
