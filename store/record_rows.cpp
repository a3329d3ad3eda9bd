// Writes and reads the rows of a record.
#include "store/record_rows.h"

#include "engine/base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace tamp {
namespace {

/// The id of the row with these values, added if there is none.
template <class... Values>
std::int64_t id_of(Statements& statements, std::string_view select, std::string_view insert, const Values&... values) {
  Query found(statements, select, values...);
  if (found.step())
    return found.integer(0);
  Query(statements, insert, values...).step();
  return statements.database().getLastInsertRowid();
}

std::int64_t build_id(Statements& statements, const Provenance& p) {
  return id_of(statements,
               "SELECT id FROM builds WHERE source_commit = ? AND dirty = ? AND compiler = ? AND flags = ? AND "
               "libraries = ?",
               "INSERT INTO builds (source_commit, dirty, compiler, flags, libraries) VALUES (?, ?, ?, ?, ?)", p.commit,
               std::int64_t{p.dirty}, p.compiler, p.flags, nlohmann::json(p.libraries).dump());
}

std::int64_t host_id(Statements& statements, const Provenance& p) {
  return id_of(statements,
               "SELECT id FROM hosts WHERE name = ? AND cpu_model = ? AND kernel = ? AND hardware_threads = ?",
               "INSERT INTO hosts (name, cpu_model, kernel, hardware_threads) VALUES (?, ?, ?, ?)", p.host, p.cpu_model,
               p.kernel, p.hardware_threads);
}

std::int64_t job_id(Statements& statements, const Record& record) {
  Query found(statements, "SELECT id FROM jobs WHERE key = ?", record.key);
  if (found.step())
    return found.integer(0);
  Query(statements, "INSERT INTO jobs (key, kind, name, revision, canonical, parent) VALUES (?, ?, ?, ?, ?, ?)",
        record.key, name_of(record.kind), record.name, record.revision, record.canonical, record.parent)
      .step();
  return statements.database().getLastInsertRowid();
}

void insert_details(Statements& statements, std::int64_t attempt, const Record& record) {
  std::int64_t position = 0;
  for (const Measure& measure : record.measures) {
    Query(statements, "INSERT INTO measures (attempt, position, name, value, unit) VALUES (?, ?, ?, ?, ?)", attempt,
          position++, measure.name, measure.value, measure.unit)
        .step();
  }
  position = 0;
  const auto insert_effect = [&](const std::string& effect, bool simulated, const std::string& why) {
    Query(statements, "INSERT INTO effects (attempt, position, effect, simulated, why) VALUES (?, ?, ?, ?, ?)", attempt,
          position++, effect, std::int64_t{simulated}, why)
        .step();
  };
  for (const std::string& effect : record.effects.simulated)
    insert_effect(effect, true, "");
  for (const auto& [effect, why] : record.effects.left_out)
    insert_effect(effect, false, why);
  position = 0;
  for (const TimeSample& sample : record.timing.samples) {
    Query(statements,
          "INSERT INTO samples (attempt, position, wall_s, cpu_s, steal_s, switches, disturbed) "
          "VALUES (?, ?, ?, ?, ?, ?, ?)",
          attempt, position++, sample.wall_s, sample.cpu_s, sample.steal_s, sample.switches, sample.disturbed)
        .step();
  }
}

void select_details(Statements& statements, std::int64_t attempt, Record& record) {
  Query measure(statements, "SELECT name, value, unit FROM measures WHERE attempt = ? ORDER BY position", attempt);
  while (measure.step())
    record.measures.push_back({measure.text(0), measure.number(1), measure.text(2)});
  Query effect(statements, "SELECT effect, simulated, why FROM effects WHERE attempt = ? ORDER BY position", attempt);
  while (effect.step()) {
    if (effect.integer(1) != 0)
      record.effects.simulated.push_back(effect.text(0));
    else
      record.effects.left_out.push_back({effect.text(0), effect.text(2)});
  }
  Query sample(statements,
               "SELECT wall_s, cpu_s, steal_s, switches, disturbed FROM samples WHERE attempt = ? ORDER BY position",
               attempt);
  while (sample.step())
    record.timing.samples.push_back(
        {sample.number(0), sample.number(1), sample.number(2), sample.integer(3), sample.text(4)});
}

constexpr std::string_view select_attempts =
    "SELECT attempts.id, key, kind, jobs.name, revision, canonical, parent, outcome, reason, timing_mode, wall_s, "
    "cpu_s, process_wall_s, process_cpu_s, peak_rss_bytes, source_commit, dirty, compiler, flags, libraries, "
    "hosts.name, cpu_model, kernel, hardware_threads, threads, start_utc, end_utc, packing_file, packing_sha256, "
    "boot_id, pid, load, switches, steal_s, governor, disturbed, wall_limit_s, cpu_limit_s, memory_limit_mb FROM jobs "
    "JOIN attempts ON attempts.job = jobs.id JOIN "
    "builds ON builds.id = build JOIN hosts ON hosts.id = host "
    "WHERE key = ? ORDER BY attempts.id DESC LIMIT ?";

/// The record of the current row of select_attempts.
Record record_of(Query& row) {
  Record r;
  int column = 1;
  const auto text = [&] { return row.text(column++); };
  const auto integer = [&] { return row.integer(column++); };
  const auto number = [&] { return row.number(column++); };
  r.key = text();
  r.kind = enum_from_row<JobKind>(text(), "kind");
  r.name = text();
  r.revision = integer();
  r.canonical = text();
  r.parent = text();
  r.outcome = enum_from_row<Outcome>(text(), "outcome");
  r.reason = text();
  r.timing.mode = enum_from_row<TimingMode>(text(), "timing_mode");
  r.timing.wall_s = number();
  r.timing.cpu_s = number();
  r.timing.process_wall_s = number();
  r.timing.process_cpu_s = number();
  r.timing.peak_rss_bytes = static_cast<std::uint64_t>(integer());
  r.provenance.commit = text();
  r.provenance.dirty = integer() != 0;
  r.provenance.compiler = text();
  r.provenance.flags = text();
  r.provenance.libraries = nlohmann::json::parse(text()).get<std::map<std::string, std::string>>();
  r.provenance.host = text();
  r.provenance.cpu_model = text();
  r.provenance.kernel = text();
  r.provenance.hardware_threads = integer();
  r.provenance.threads = integer();
  r.provenance.start_utc = text();
  r.provenance.end_utc = text();
  r.packing_file = text();
  r.packing_sha256 = text();
  r.provenance.boot_id = text();
  r.provenance.pid = integer();
  r.timing.conditions.load = number();
  r.timing.conditions.switches = integer();
  r.timing.conditions.steal_s = number();
  r.timing.conditions.governor = text();
  r.timing.conditions.disturbed = text();
  r.limits.wall_s = number();
  r.limits.cpu_s = number();
  r.limits.memory_mb = integer();
  return r;
}

} // namespace

void check_storable(const Record& record) {
  const auto check = [&](double value, const std::string& what) {
    if (!std::isfinite(value))
      throw Error(fmt::format("record {}: {} is {}; only finite numbers can be recorded", record.key, what, value));
  };
  std::set<std::string_view> names;
  for (const Measure& measure : record.measures) {
    check(measure.value, "the measure " + measure.name);
    if (!names.insert(measure.name).second)
      throw Error(fmt::format("record {}: two measures have the name {}", record.key, measure.name));
  }
  check(record.timing.wall_s, "the wall time");
  check(record.timing.cpu_s, "the CPU time");
  check(record.timing.process_wall_s, "the wall time of the process");
  check(record.timing.process_cpu_s, "the CPU time of the process");
  for (const TimeSample& sample : record.timing.samples)
    check(sample.wall_s + sample.cpu_s + sample.steal_s, "a time");
  check(record.limits.wall_s + record.limits.cpu_s, "a limit");
  check(record.timing.conditions.load, "the load average");
  check(record.timing.conditions.steal_s, "the time that the hypervisor took");
}

bool insert_record(Statements& statements, const Record& record) {
  const std::int64_t job = job_id(statements, record);
  {
    Query latest(statements, "SELECT outcome, start_utc, end_utc FROM attempts WHERE job = ? ORDER BY id DESC LIMIT 1",
                 job);
    if (latest.step()) {
      const bool is_same_run = !record.provenance.start_utc.empty() && latest.text(1) == record.provenance.start_utc &&
                               latest.text(2) == record.provenance.end_utc;
      if (is_same_run || latest.text(0) == name_of(Outcome::ok))
        return false;
    }
  }
  const Timing& t = record.timing;
  const Provenance& p = record.provenance;
  Query(statements,
        "INSERT INTO attempts (job, outcome, reason, timing_mode, wall_s, cpu_s, process_wall_s, process_cpu_s, "
        "peak_rss_bytes, build, host, threads, start_utc, end_utc, packing_file, packing_sha256, boot_id, pid, load, "
        "switches, steal_s, governor, disturbed, wall_limit_s, cpu_limit_s, memory_limit_mb) "
        "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        job, name_of(record.outcome), record.reason, name_of(t.mode), t.wall_s, t.cpu_s, t.process_wall_s,
        t.process_cpu_s, static_cast<std::int64_t>(t.peak_rss_bytes), build_id(statements, p), host_id(statements, p),
        p.threads, p.start_utc, p.end_utc, record.packing_file, record.packing_sha256, p.boot_id, p.pid,
        t.conditions.load, t.conditions.switches, t.conditions.steal_s, t.conditions.governor, t.conditions.disturbed,
        record.limits.wall_s, record.limits.cpu_s, record.limits.memory_mb)
      .step();
  insert_details(statements, statements.database().getLastInsertRowid(), record);
  return true;
}

std::optional<Outcome> latest_outcome(Statements& statements, std::string_view key) {
  Query row(statements,
            "SELECT outcome FROM jobs JOIN attempts ON attempts.job = jobs.id WHERE key = ? "
            "ORDER BY attempts.id DESC LIMIT 1",
            key);
  if (!row.step())
    return std::nullopt;
  return enum_from_row<Outcome>(row.text(0), "outcome");
}

std::vector<Record> select_records(Statements& statements, std::string_view key, bool latest_only) {
  std::vector<Record> records;
  Query row(statements, select_attempts, key, std::int64_t{latest_only ? 1 : -1});
  while (row.step()) {
    records.push_back(record_of(row));
    select_details(statements, row.integer(0), records.back());
  }
  std::reverse(records.begin(), records.end());
  return records;
}

} // namespace tamp
