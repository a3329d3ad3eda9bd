// ClusterProfile: what a cluster wants to know of every job, and how tamp should use it.
#pragma once

#include <cstdint>
#include <string>

namespace tamp {

/// Empty text: not stated, the cluster's default holds.
struct ClusterProfile {
  std::string partition;
  std::string account;
  std::string qos;
  std::string constraint;
  std::int64_t max_running = 0;          ///< elements of one array that may run at a time; 0: no bound
  std::int64_t array_size = 1000;        ///< elements of one array at most; never above what the cluster allows
  std::int64_t bundle_jobs = 50;         ///< jobs that one element runs in turn, at most
  double bundle_wall_s = 600;            ///< sum of their time budgets, at most; a longer job stands alone
  std::int64_t memory_overhead_mb = 200; ///< asked for beside the budget of the job
  double settle_s = 30;   ///< how long an element must have been gone before it counts as lost without a result
  double patience_s = 30; ///< how long a controller that does not answer is asked again before `submit` gives up
};

} // namespace tamp
