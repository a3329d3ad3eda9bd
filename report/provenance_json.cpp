// Writes runs as JSON.
#include "report/provenance_json.h"

#include "engine/base/canonical_json.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

namespace tamp {

namespace {

void add_measures(std::string& out, const std::vector<Measure>& measures, std::set<std::string>& seen) {
  for (const Measure& measure : measures) {
    if (std::isfinite(measure.value) && seen.insert(measure.name).second)
      out += fmt::format("{}{}:{}", seen.size() > 1 ? "," : "", script_string(measure.name),
                         canonical_number(measure.value));
  }
}

std::string run_json(const Run& run) {
  const Record& record = *run.generation;
  const Provenance& from = record.provenance;
  std::string out = fmt::format(
      R"("method":{},"seed":{},"replicate":{},"parent":{},"job":{},"outcome":{},"reason":{},"commit":{},"dirty":{},)",
      script_string(run.planned.label), run.planned.job.seed, run.planned.job.replicate,
      script_string(run.planned.job.parent), script_string(canonical(run.planned.job)),
      script_string(name_of(record.outcome)), script_string(record.reason), script_string(from.commit), from.dirty);
  out += fmt::format(R"("host":{},"cpu":{},"compiler":{},"start":{},"mode":{},"wall":{},"measures":{{)",
                     script_string(from.host), script_string(from.cpu_model), script_string(from.compiler),
                     script_string(from.start_utc), script_string(name_of(record.timing.mode)),
                     canonical_number(record.timing.wall_s));
  std::set<std::string> seen;
  add_measures(out, record.measures, seen);
  for (const MetricRun& metric : run.metrics) {
    if (metric.record && metric.record->outcome == Outcome::ok)
      add_measures(out, metric.record->measures, seen);
  }
  out += "},\"metrics\":{";
  for (std::size_t i = 0; i < run.metrics.size(); ++i)
    out += fmt::format("{}{}:{}", i == 0 ? "" : ",", script_string(name_of(run.metrics[i].metric.name)),
                       script_string(run.metrics[i].key));
  return "{" + out + "}}";
}

} // namespace

std::string script_string(std::string_view words) {
  std::string out;
  for (const char c : canonical_string(words))
    out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

std::string provenance_json(std::span<const Run> runs) {
  std::string out = "{";
  for (const Run& run : runs) {
    if (run.generation)
      out += fmt::format("{}{}:{}", out.size() > 1 ? ",\n" : "\n", script_string(run.planned.key), run_json(run));
  }
  return out + "\n}";
}

} // namespace tamp
