// Record to JSON and back.
#include "store/record_json.h"

#include "engine/base/error.h"
#include "engine/base/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tamp {
namespace {

using Json = nlohmann::ordered_json;

/// Goes up when the form changes; a text of another form is refused.
constexpr int form = 1;

double finite(double value, std::string_view what) {
  if (!std::isfinite(value))
    throw Error(fmt::format("{} is {}; only finite numbers can be recorded", what, value));
  return value;
}

Json measures_to_json(const std::vector<Measure>& measures) {
  Json list = Json::array();
  for (const Measure& m : measures)
    list.push_back({{"name", m.name}, {"value", finite(m.value, "the measure " + m.name)}, {"unit", m.unit}});
  return list;
}

Json effects_to_json(const Effects& effects) {
  Json left_out = Json::array();
  for (const auto& [effect, why] : effects.left_out)
    left_out.push_back({{"effect", effect}, {"why", why}});
  return {{"simulated", effects.simulated}, {"left_out", left_out}};
}

Json samples_to_json(const std::vector<TimeSample>& samples) {
  Json list = Json::array();
  for (const TimeSample& s : samples)
    list.push_back({{"wall_s", finite(s.wall_s, "wall_s")},
                    {"cpu_s", finite(s.cpu_s, "cpu_s")},
                    {"steal_s", finite(s.steal_s, "steal_s")},
                    {"switches", s.switches},
                    {"disturbed", s.disturbed}});
  return list;
}

Json timing_to_json(const Timing& t) {
  return {{"mode", name_of(t.mode)},
          {"wall_s", finite(t.wall_s, "wall_s")},
          {"cpu_s", finite(t.cpu_s, "cpu_s")},
          {"process_wall_s", finite(t.process_wall_s, "process_wall_s")},
          {"process_cpu_s", finite(t.process_cpu_s, "process_cpu_s")},
          {"peak_rss_bytes", t.peak_rss_bytes},
          {"conditions",
           {{"load", finite(t.conditions.load, "load")},
            {"switches", t.conditions.switches},
            {"steal_s", finite(t.conditions.steal_s, "steal_s")},
            {"governor", t.conditions.governor},
            {"disturbed", t.conditions.disturbed}}},
          {"samples", samples_to_json(t.samples)}};
}

Json provenance_to_json(const Provenance& p) {
  return {{"commit", p.commit},
          {"dirty", p.dirty},
          {"compiler", p.compiler},
          {"flags", p.flags},
          {"libraries", p.libraries},
          {"host", p.host},
          {"cpu_model", p.cpu_model},
          {"kernel", p.kernel},
          {"hardware_threads", p.hardware_threads},
          {"threads", p.threads},
          {"start_utc", p.start_utc},
          {"end_utc", p.end_utc},
          {"boot_id", p.boot_id},
          {"pid", p.pid}};
}

template <class E>
E enum_at(const Json& json, const char* key) {
  const std::string name = json.at(key);
  if (const auto value = enum_of<E>(name))
    return *value;
  throw Error(fmt::format("\"{}\" is \"{}\", which this tamp does not know", key, name));
}

Effects effects_from_json(const Json& json) {
  Effects effects;
  effects.simulated = json.at("simulated").get<std::vector<std::string>>();
  for (const Json& item : json.at("left_out"))
    effects.left_out.push_back({item.at("effect"), item.at("why")});
  return effects;
}

Timing timing_from_json(const Json& json) {
  Timing t;
  t.mode = enum_at<TimingMode>(json, "mode");
  t.wall_s = json.at("wall_s");
  t.cpu_s = json.at("cpu_s");
  t.process_wall_s = json.at("process_wall_s");
  t.process_cpu_s = json.at("process_cpu_s");
  t.peak_rss_bytes = json.at("peak_rss_bytes");
  if (const auto found = json.find("conditions"); found != json.end()) {
    t.conditions.load = found->at("load");
    t.conditions.switches = found->at("switches");
    t.conditions.steal_s = found->at("steal_s");
    t.conditions.governor = found->at("governor");
    t.conditions.disturbed = found->at("disturbed");
  }
  if (const auto found = json.find("samples"); found != json.end()) {
    for (const Json& s : *found)
      t.samples.push_back({s.at("wall_s"), s.at("cpu_s"), s.at("steal_s"), s.at("switches"), s.at("disturbed")});
  }
  return t;
}

Json limits_to_json(const Limits& limits) {
  return {{"wall_s", finite(limits.wall_s, "the limit wall_s")},
          {"cpu_s", finite(limits.cpu_s, "the limit cpu_s")},
          {"memory_mb", limits.memory_mb}};
}

Provenance provenance_from_json(const Json& json) {
  Provenance p;
  p.commit = json.at("commit");
  p.dirty = json.at("dirty");
  p.compiler = json.at("compiler");
  p.flags = json.at("flags");
  p.libraries = json.at("libraries").get<std::map<std::string, std::string>>();
  p.host = json.at("host");
  p.cpu_model = json.at("cpu_model");
  p.kernel = json.at("kernel");
  p.hardware_threads = json.at("hardware_threads");
  p.threads = json.at("threads");
  p.start_utc = json.at("start_utc");
  p.end_utc = json.at("end_utc");
  p.boot_id = json.value("boot_id", ""); // not in the results of older programs, as the next below
  p.pid = json.value("pid", std::int64_t{0});
  return p;
}

Record record_of(const Json& json) {
  if (const int found = json.at("tamp_record"); found != form)
    throw Error(fmt::format("the form of the record is {}; this tamp reads {}", found, form));
  Record r;
  r.key = json.at("key");
  r.kind = enum_at<JobKind>(json, "kind");
  r.name = json.at("name");
  r.revision = json.at("revision");
  r.canonical = json.at("canonical");
  r.parent = json.at("parent");
  r.outcome = enum_at<Outcome>(json, "outcome");
  r.reason = json.at("reason");
  r.effects = effects_from_json(json.at("effects"));
  for (const Json& m : json.at("measures"))
    r.measures.push_back({m.at("name"), m.at("value"), m.at("unit")});
  r.timing = timing_from_json(json.at("timing"));
  if (const auto found = json.find("limits"); found != json.end())
    r.limits = {found->at("wall_s"), found->at("cpu_s"), found->at("memory_mb")};
  r.provenance = provenance_from_json(json.at("provenance"));
  r.packing_file = json.at("packing_file");
  r.packing_sha256 = json.at("packing_sha256");
  return r;
}

} // namespace

std::string record_to_json(const Record& r) {
  try {
    const Json json{{"tamp_record", form},
                    {"key", r.key},
                    {"kind", name_of(r.kind)},
                    {"name", r.name},
                    {"revision", r.revision},
                    {"canonical", r.canonical},
                    {"parent", r.parent},
                    {"outcome", name_of(r.outcome)},
                    {"reason", r.reason},
                    {"effects", effects_to_json(r.effects)},
                    {"measures", measures_to_json(r.measures)},
                    {"timing", timing_to_json(r.timing)},
                    {"limits", limits_to_json(r.limits)},
                    {"provenance", provenance_to_json(r.provenance)},
                    {"packing_file", r.packing_file},
                    {"packing_sha256", r.packing_sha256}};
    // A reason may quote the log of a child process, which may hold any bytes.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  } catch (const Error& e) {
    throw Error(fmt::format("record {}: {}", r.key, e.what()));
  }
}

Record record_from_json(std::string_view text, std::string_view where) {
  try {
    return record_of(Json::parse(text));
  } catch (const nlohmann::json::exception& e) {
    throw Error(fmt::format("{} is not a whole record: {}", where, e.what()));
  } catch (const Error& e) {
    throw Error(fmt::format("{}: {}", where, e.what()));
  }
}

void write_record(const std::filesystem::path& path, const Record& record) {
  write_atomically(path, record_to_json(record));
}

Record read_record(const std::filesystem::path& path) {
  return record_from_json(read_file(path), path.string());
}

} // namespace tamp
