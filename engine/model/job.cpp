// Canonical text and keys of jobs.
#include "engine/model/job.h"

#include "engine/base/sha256.h"
#include "engine/model/parameter.h"

namespace tamp {

std::string canonical(const Job& job) {
  JsonPaths document;
  document["kind"] = std::string("generation");
  document["seed"] = job.seed;
  document["replicate"] = job.replicate;
  document["method/revision"] = info(job.method.name).revision;
  if (!job.parent.empty())
    document["parent"] = job.parent;
  collect(scene_parameters(), job.scene, "scene/", document);
  collect(method_parameters(), job.method, "method/", document);
  return canonical_json(document);
}

std::string job_key(const Job& job) {
  return sha256_hex(canonical(job));
}

std::string canonical(const Metric& metric, const std::string& packing_key) {
  JsonPaths document;
  document["kind"] = std::string("metric");
  document["parent"] = packing_key;
  document["metric/revision"] = info(metric.name).revision;
  collect(metric_parameters(), metric, "metric/", document);
  return canonical_json(document);
}

std::string metric_key(const Metric& metric, const std::string& packing_key) {
  return sha256_hex(canonical(metric, packing_key));
}

} // namespace tamp
