// Job files: one job as text, for the child process that runs it.
#pragma once

#include "engine/model/job.h"

#include <string>
#include <string_view>

namespace tamp {

/// The job as JSON: its canonical text. The scene must be completed.
std::string job_json(const Job& job);

/// The job of such a text, exactly: job_key(read_job(job_json(job))) == job_key(job). Throws InputError if the text is
/// no job, or one of another revision of its method, which this program could not run to the same bytes.
Job read_job(std::string_view text);

/// A metric and the packing that it is measured on.
struct MetricJob {
  Metric metric;
  std::string packing; ///< key
};

/// The same for the canonical text of a metric (engine/model/job.h).
MetricJob read_metric_job(std::string_view text);

} // namespace tamp
