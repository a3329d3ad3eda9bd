// Plan: a campaign expanded into jobs — plain data between the campaign reader, the scheduler and the report.
#pragma once

#include "engine/model/job.h"
#include "engine/model/psd.h"
#include "engine/model/record.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tamp {

/// How jobs run; none of it changes what they find.
struct RunSettings {
  double wall_s = 3600;          ///< budget of one job
  double cpu_s = 0;              ///< budget of one job; 0: none
  std::int64_t memory_mb = 4096; ///< budget of one job
  TimingMode timing = TimingMode::shared;
  std::int64_t samples = 1; ///< times that a job timed alone is run
};

/// One job of a campaign with the words the campaign has for it.
struct PlannedJob {
  Job job;
  std::string key;
  std::string label;                        ///< of the method entry; defaults to the method's name
  std::map<std::string, std::string> point; ///< swept path → value, for listings
};

/// "drop-and-roll, scene/size = 60, replicate 3": a generation job as its campaign calls it.
std::string job_name(const std::string& label, const std::map<std::string, std::string>& point, std::int64_t replicate);

struct ReportSettings {
  std::vector<std::string> tables; ///< names of report tables, "lognormal_2d" …
  double phi_exp = unstated;       ///< packing fraction of an experiment on the campaign's powder
};

struct Plan {
  std::string campaign; ///< name
  std::string title;
  std::string file; ///< as given on the command line
  RunSettings run;
  ReportSettings report;
  std::vector<Metric> metrics;
  std::vector<PlannedJob> jobs; ///< in the order of the file; keys are unique
};

} // namespace tamp
