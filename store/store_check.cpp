// Compares the records with the files.
#include "store/store_check.h"

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/sha256.h"
#include "store/file_digest.h"
#include "store/record_rows.h"
#include "store/store_parts.h"

#include <SQLiteCpp/Transaction.h>
#include <fmt/format.h>

#include <set>

namespace tamp {

namespace {

namespace fs = std::filesystem;

bool has_digest(const fs::path& file, const std::string& sha256) {
  try {
    return file_sha256(file) == sha256;
  } catch (const Error&) { // a bad sector, or no right to read
    return false;
  }
}

/// Moves a file into the quarantine, under a name that is free there.
void move_aside(const fs::path& store, const fs::path& file) {
  try {
    const fs::path folder = quarantine_folder(store);
    fs::create_directories(folder);
    fs::path to = folder / file.filename();
    for (int number = 1; fs::exists(to); ++number)
      to = folder / fmt::format("{}.{}", file.filename().string(), number);
    fs::rename(file, to);
  } catch (const fs::filesystem_error& e) {
    throw Error(e.what());
  }
}

/// Calls `read`, which may meet damage; what it has done until then counts.
template <class F>
void until_damage(F&& read) {
  try {
    read();
  } catch (const std::exception&) {
    return; // SQLite's words for it have been told by the check already
  }
}

/// The keys of a damaged database: by its index of keys, and one by one, as different pages hold the two.
std::set<std::string> readable_keys(Statements& statements) {
  std::set<std::string> keys;
  until_damage([&] {
    Query row(statements, "SELECT key FROM jobs INDEXED BY kinds_of_keys ORDER BY key");
    while (row.step())
      keys.insert(row.text(0));
  });
  std::int64_t last = 0;
  until_damage([&] {
    Query row(statements, "SELECT max(id) FROM jobs");
    last = row.step() ? row.integer(0) : 0;
  });
  for (std::int64_t id = 1; id <= last; ++id) {
    until_damage([&] {
      Query row(statements, "SELECT key FROM jobs WHERE id = ?", id);
      if (row.step())
        keys.insert(row.text(0));
    });
  }
  return keys;
}

/// The attempts of a damaged database that can be read and are what their keys say.
std::vector<Record> readable_attempts(const fs::path& file) {
  std::vector<Record> records;
  until_damage([&] {
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE); // to see what is in the write-ahead log, too
    until_damage([&] { bring_up_to_date(database, schema_steps()); });
    Statements statements(database);
    for (const std::string& key : readable_keys(statements)) {
      until_damage([&] {
        for (Record& record : select_records(statements, key, false)) {
          check_storable(record);
          if (sha256_hex(record.canonical) == record.key)
            records.push_back(std::move(record));
        }
      });
    }
  });
  return records;
}

} // namespace

StoreFindings check_store(const Store& store) {
  StoreFindings findings;
  std::set<fs::path> named;
  for (const auto& [key, outcome] : store.outcomes(JobKind::generation)) {
    const std::optional<Record> record = store.find(key);
    if (!record || record->packing_file.empty())
      continue;
    const fs::path file = store.folder() / record->packing_file;
    named.insert(file);
    if (!fs::exists(file))
      findings.missing.push_back(key);
    else if (has_digest(file, record->packing_sha256))
      ++findings.intact;
    else
      findings.damaged.push_back(file);
  }
  const fs::path packings = store.folder() / "packings";
  if (fs::exists(packings)) {
    for (const auto& entry : fs::recursive_directory_iterator(packings)) {
      if (entry.is_regular_file() && entry.path().extension() == ".h5" && !named.contains(entry.path()))
        findings.unrecorded.push_back(entry.path());
    }
  }
  return findings;
}

fs::path quarantine_folder(const fs::path& store) {
  return store / "quarantine";
}

void quarantine(const Store& store, const StoreFindings& findings) {
  for (const auto* files : {&findings.damaged, &findings.unrecorded}) {
    for (const fs::path& file : *files)
      move_aside(store.folder(), file);
  }
}

std::size_t salvage_database(const fs::path& store) {
  const fs::path file = store / "tamp.sqlite";
  const fs::path fresh = temporary_name(file);
  const std::size_t count = with_named_file(fresh, [&] {
    SQLite::Database made = open_database(fresh, true);
    Statements statements(made);
    SQLite::Transaction all(made, SQLite::TransactionBehavior::IMMEDIATE);
    std::size_t taken = 0;
    for (const Record& record : readable_attempts(file))
      taken += insert_record(statements, record) ? 1U : 0U;
    all.commit();
    made.exec("PRAGMA journal_mode = DELETE"); // into one file, which can be renamed
    return taken;
  });
  for (const char* part : {"", "-wal", "-shm"}) {
    if (const fs::path old = file.string() + part; fs::exists(old))
      move_aside(store, old);
  }
  publish(fresh, file);
  return count;
}

} // namespace tamp
