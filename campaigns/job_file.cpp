// Reads jobs back from their canonical text, through the same tables that wrote it.
#include "campaigns/job_file.h"

#include "campaigns/json_document.h"
#include "campaigns/rules.h"
#include "engine/base/error.h"

#include <fmt/format.h>

namespace tamp {

namespace {

/// Sets every row of the table that the object (nested as the paths are) holds.
template <class Root>
void set_all(const JsonNode& object, std::span<const Parameter<Root>> table, const std::string& pointer, Root& root,
             Mistakes& mistakes) {
  for (const auto& row : table) {
    const JsonNode* node = &object;
    std::string_view rest = row.path;
    std::string place = pointer;
    while (node != nullptr && !rest.empty()) {
      const std::size_t slash = std::min(rest.find('/'), rest.size());
      node = node->find(rest.substr(0, slash));
      place = json_pointer(place, rest.substr(0, slash));
      rest.remove_prefix(std::min(slash + 1, rest.size()));
    }
    if (node == nullptr)
      continue;
    if (const auto leaf = read_value(*node, ValueRule(row), place, mistakes))
      row.set(root, *leaf);
  }
}

const JsonNode& member(const JsonNode& root, std::string_view key) {
  const JsonNode* node = root.find(key);
  if (node == nullptr)
    throw InputError(fmt::format("job file: \"{}\" is missing", key));
  return *node;
}

std::int64_t whole_number(const JsonNode& object, std::string_view key, Mistakes& mistakes) {
  Parameter<Repeats> row = *find_row(repeat_parameters(), "seed");
  row.range = {};
  const auto leaf = read_value(member(object, key), ValueRule(row), json_pointer("", key), mistakes);
  mistakes.throw_if_any();
  return std::get<std::int64_t>(*leaf);
}

} // namespace

std::string job_json(const Job& job) {
  return canonical(job);
}

Job read_job(std::string_view text) {
  Mistakes mistakes("job file", text);
  const JsonDocument document = parse_json(text);
  const JsonNode& root = document.root;
  if (member(root, "kind").text != "generation")
    throw InputError("job file: \"kind\" is not \"generation\"");
  Job job;
  job.seed = whole_number(root, "seed", mistakes);
  job.replicate = whole_number(root, "replicate", mistakes);
  if (const JsonNode* parent = root.find("parent"))
    job.parent = parent->text;
  set_all(member(root, "scene"), scene_parameters(), "/scene", job.scene, mistakes);
  const JsonNode& method = member(root, "method");
  set_all(method, method_parameters(), "/method", job.method, mistakes);
  const std::int64_t revision = whole_number(method, "revision", mistakes);
  mistakes.throw_if_any();
  if (revision != info(job.method.name).revision)
    throw InputError(fmt::format("job file: made for revision {} of {}, this program has revision {}", revision,
                                 name_of(job.method.name), info(job.method.name).revision));
  // What this program does not know of a job would silently not count: the text must be the job's own, to the byte.
  if (canonical(job) != text.substr(0, text.find_last_not_of(" \r\n\t") + 1))
    throw InputError("job file: holds more, less or other than the canonical text of its job");
  return job;
}

MetricJob read_metric_job(std::string_view text) {
  Mistakes mistakes("metric", text);
  const JsonDocument document = parse_json(text);
  if (member(document.root, "kind").text != "metric")
    throw InputError("metric: \"kind\" is not \"metric\"");
  MetricJob job;
  job.packing = member(document.root, "parent").text;
  set_all(member(document.root, "metric"), metric_parameters(), "/metric", job.metric, mistakes);
  mistakes.throw_if_any();
  if (canonical(job.metric, job.packing) != text)
    throw InputError(fmt::format("metric: made by another revision of {}, or by a tamp that knew other parameters",
                                 name_of(job.metric.name)));
  return job;
}

} // namespace tamp
