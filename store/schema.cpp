// Tables and migrations.
#include "store/schema.h"

#include "engine/base/error.h"

#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>

namespace tamp {
namespace {

constexpr int busy_timeout_ms = 30'000;
constexpr int cache_kib = 64 * 1024; // holds the indexes of some hundred thousand keys

// A job is what its key names, once; each run of it is an attempt; measures and effects belong to the attempt.
// campaign_jobs has no foreign key to jobs, as a campaign names its jobs before they have run.
constexpr const char* version_1 = R"(
CREATE TABLE builds (
  id INTEGER PRIMARY KEY,
  source_commit TEXT NOT NULL, dirty INTEGER NOT NULL CHECK (dirty IN (0, 1)),
  compiler TEXT NOT NULL, flags TEXT NOT NULL, libraries TEXT NOT NULL,
  UNIQUE (source_commit, dirty, compiler, flags, libraries)
) STRICT;
CREATE TABLE hosts (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL, cpu_model TEXT NOT NULL, kernel TEXT NOT NULL, hardware_threads INTEGER NOT NULL,
  UNIQUE (name, cpu_model, kernel, hardware_threads)
) STRICT;
CREATE TABLE jobs (
  id INTEGER PRIMARY KEY,
  key TEXT NOT NULL UNIQUE, kind TEXT NOT NULL, name TEXT NOT NULL, revision INTEGER NOT NULL,
  canonical TEXT NOT NULL, parent TEXT NOT NULL
) STRICT;
CREATE INDEX kinds_of_keys ON jobs (key, kind); -- lists keys without reading the long canonical texts
CREATE INDEX jobs_of_parent ON jobs (parent, kind);
CREATE TABLE attempts (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  job INTEGER NOT NULL REFERENCES jobs (id),
  outcome TEXT NOT NULL, reason TEXT NOT NULL,
  timing_mode TEXT NOT NULL, wall_s REAL NOT NULL, cpu_s REAL NOT NULL,
  process_wall_s REAL NOT NULL, process_cpu_s REAL NOT NULL, peak_rss_bytes INTEGER NOT NULL,
  build INTEGER NOT NULL REFERENCES builds (id), host INTEGER NOT NULL REFERENCES hosts (id),
  threads INTEGER NOT NULL, start_utc TEXT NOT NULL, end_utc TEXT NOT NULL,
  packing_file TEXT NOT NULL, packing_sha256 TEXT NOT NULL
) STRICT;
CREATE INDEX attempts_of_job ON attempts (job, id, outcome);
CREATE TABLE measures (
  attempt INTEGER NOT NULL REFERENCES attempts (id), position INTEGER NOT NULL,
  name TEXT NOT NULL, value REAL NOT NULL, unit TEXT NOT NULL,
  PRIMARY KEY (attempt, position)
) STRICT, WITHOUT ROWID;
CREATE TABLE effects (
  attempt INTEGER NOT NULL REFERENCES attempts (id), position INTEGER NOT NULL,
  effect TEXT NOT NULL, simulated INTEGER NOT NULL CHECK (simulated IN (0, 1)), why TEXT NOT NULL,
  PRIMARY KEY (attempt, position)
) STRICT, WITHOUT ROWID;
CREATE TABLE campaigns (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE, title TEXT NOT NULL, file TEXT NOT NULL, settings TEXT NOT NULL
) STRICT;
CREATE TABLE campaign_jobs (
  campaign INTEGER NOT NULL REFERENCES campaigns (id), position INTEGER NOT NULL,
  key TEXT NOT NULL, label TEXT NOT NULL, replicate INTEGER NOT NULL, point TEXT NOT NULL,
  PRIMARY KEY (campaign, position), UNIQUE (campaign, key)
) STRICT, WITHOUT ROWID;
CREATE INDEX campaigns_of_key ON campaign_jobs (key);
)";

// Which process ran an attempt, and what went on on its machine meanwhile.
constexpr const char* version_2 = R"(
ALTER TABLE attempts ADD COLUMN boot_id TEXT NOT NULL DEFAULT '';
ALTER TABLE attempts ADD COLUMN pid INTEGER NOT NULL DEFAULT 0;
ALTER TABLE attempts ADD COLUMN load REAL NOT NULL DEFAULT 0;
ALTER TABLE attempts ADD COLUMN switches INTEGER NOT NULL DEFAULT 0;
ALTER TABLE attempts ADD COLUMN steal_s REAL NOT NULL DEFAULT 0;
ALTER TABLE attempts ADD COLUMN governor TEXT NOT NULL DEFAULT '';
ALTER TABLE attempts ADD COLUMN disturbed TEXT NOT NULL DEFAULT '';
)";

// What a job was allowed to use, and the single times of one that was run more than once.
constexpr const char* version_3 = R"(
ALTER TABLE attempts ADD COLUMN wall_limit_s REAL NOT NULL DEFAULT 0;
ALTER TABLE attempts ADD COLUMN cpu_limit_s REAL NOT NULL DEFAULT 0;
ALTER TABLE attempts ADD COLUMN memory_limit_mb INTEGER NOT NULL DEFAULT 0;
CREATE TABLE samples (
  attempt INTEGER NOT NULL REFERENCES attempts (id), position INTEGER NOT NULL,
  wall_s REAL NOT NULL, cpu_s REAL NOT NULL, steal_s REAL NOT NULL, switches INTEGER NOT NULL, disturbed TEXT NOT NULL,
  PRIMARY KEY (attempt, position)
) STRICT, WITHOUT ROWID;
)";

constexpr std::array<const char*, 3> steps_of_schema{version_1, version_2, version_3};

int pragma(SQLite::Database& database, const char* name) {
  return database.execAndGet(fmt::format("PRAGMA {}", name)).getInt();
}

/// The version of the file; throws Error unless it is a store, or empty and on the way to become one.
int checked_version(SQLite::Database& database, int newest) {
  const int version = pragma(database, "user_version");
  const int owner = pragma(database, "application_id");
  const bool is_empty = database.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  const bool is_fresh = version == 0 && owner == 0 && is_empty;
  if (!is_fresh && owner != application_id)
    throw Error(fmt::format("{} is a database of another program, not a store of tamp", database.getFilename()));
  if (version > newest) {
    throw Error(fmt::format("{} was written by a newer tamp: its schema has version {}, this tamp knows versions up to "
                            "{}; use the newer tamp",
                            database.getFilename(), version, newest));
  }
  return version;
}

} // namespace

std::span<const char* const> schema_steps() {
  return steps_of_schema;
}

void bring_up_to_date(SQLite::Database& database, std::span<const char* const> steps) {
  const int newest = static_cast<int>(steps.size());
  if (checked_version(database, newest) == newest)
    return;
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  // Asked again under the lock: another process may have been faster.
  for (int version = checked_version(database, newest); version < newest; ++version)
    database.exec(steps[static_cast<std::size_t>(version)]);
  database.exec(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application_id, newest));
  transaction.commit();
}

namespace {

/// The file as an SQLite URI for a place that cannot be written to. SQLite then needs neither the lock nor the shared
/// memory files of its write-ahead log, which it could not make there.
std::string immutable_uri(const std::filesystem::path& file) {
  std::string uri = "file:";
  for (const char c : file.string()) {
    if (c == '%' || c == '?' || c == '#') {
      uri += fmt::format("%{:02X}", static_cast<unsigned>(c));
    } else {
      uri += c;
    }
  }
  return uri + "?immutable=1";
}

} // namespace

SQLite::Database open_database(const std::filesystem::path& file, bool writable, bool network) {
  if (!writable && !std::filesystem::exists(file)) {
    throw Error(fmt::format("there is no store in {}: {} is missing; `tamp run` makes one", file.parent_path().string(),
                            file.string()));
  }
  const bool fixed = !writable && ::access(file.parent_path().c_str(), W_OK) != 0;
  const int flags = writable ? SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE : SQLite::OPEN_READONLY | SQLite::OPEN_URI;
  SQLite::Database database(fixed ? immutable_uri(file) : file.string(), flags, busy_timeout_ms);
  database.exec(fmt::format("PRAGMA foreign_keys = ON; PRAGMA cache_size = -{}", cache_kib));
  if (writable) {
    bring_up_to_date(database, schema_steps());
    // A write-ahead log needs memory that all its users share, which those on two machines cannot.
    database.exec(network ? "PRAGMA journal_mode = DELETE" : "PRAGMA journal_mode = WAL");
    // FULL: a record outlives a loss of power once put() has returned; the packing was synced before it.
    database.exec("PRAGMA synchronous = FULL");
  } else {
    const int newest = static_cast<int>(schema_steps().size());
    if (const int version = checked_version(database, newest); version < newest) {
      throw Error(
          fmt::format("{} has schema version {}, older than this tamp's {}; the next `tamp run` into this store "
                      "brings it up to date",
                      file.string(), version, newest));
    }
  }
  return database;
}

} // namespace tamp
