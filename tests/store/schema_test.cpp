// Migrations: a new file gets the tables, an older one the steps it lacks, others are refused.
#include "engine/base/error.h"
#include "store/schema.h"
#include "store/store.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/store/examples.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include <array>
#include <string>

using namespace tamp;
using Catch::Matchers::Contains;

namespace {

SQLite::Database writable(const std::filesystem::path& file) {
  return SQLite::Database(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
}

int number(SQLite::Database& database, const std::string& sql) {
  return database.execAndGet(sql).getInt();
}

} // namespace

TEST_CASE("a new store has the newest version, our mark, WAL and only STRICT tables") {
  const ScratchFolder folder;
  { Store::open(folder / "s", Store::Mode::create); }
  SQLite::Database database(folder.path() / "s" / "tamp.sqlite");
  CHECK(number(database, "PRAGMA user_version") == static_cast<int>(schema_steps().size()));
  CHECK(number(database, "PRAGMA application_id") == application_id);
  CHECK(database.execAndGet("PRAGMA journal_mode").getString() == "wal");
  CHECK(number(database, "SELECT count(*) FROM pragma_table_list WHERE type = 'table' AND name NOT LIKE 'sqlite%' AND "
                         "strict = 0") == 0);
  CHECK(number(database, "SELECT count(*) FROM pragma_table_list WHERE strict = 1") == 9);
}

TEST_CASE("on a network file system a store does without the write-ahead log, also one that had it") {
  const ScratchFolder folder;
  const auto file = folder / "tamp.sqlite";
  const auto mode = [&] { return SQLite::Database(file).execAndGet("PRAGMA journal_mode").getString(); };
  { open_database(file, true); }
  CHECK(mode() == "wal");
  {
    SQLite::Database database = open_database(file, true, true);
    database.exec("INSERT INTO campaigns (name, title, file, settings) VALUES ('a', '', '', '{}')");
    CHECK_FALSE(std::filesystem::exists(file.string() + "-wal"));
  }
  CHECK(mode() == "delete");
  { open_database(file, true); }
  CHECK(mode() == "wal");
  SQLite::Database database(file);
  CHECK(number(database, "SELECT count(*) FROM campaigns") == 1);
}

TEST_CASE("foreign keys are kept") {
  const ScratchFolder folder;
  { Store::open(folder / "s", Store::Mode::create); }
  SQLite::Database database = open_database(folder.path() / "s" / "tamp.sqlite", true);
  CHECK_THROWS_WITH(database.exec("INSERT INTO measures VALUES (77, 0, 'phi', 0.5, '1')"), Contains("FOREIGN KEY"));
}

TEST_CASE("a file of version 0 and one of version 1 get the steps they lack, with their rows kept") {
  const ScratchFolder folder;
  const std::array steps{"CREATE TABLE a (x INTEGER) STRICT", "ALTER TABLE a ADD COLUMN y INTEGER NOT NULL DEFAULT 5"};
  SQLite::Database database = writable(folder / "d");
  bring_up_to_date(database, std::span(steps).first(1));
  CHECK(number(database, "PRAGMA user_version") == 1);
  database.exec("INSERT INTO a VALUES (3)");
  bring_up_to_date(database, steps);
  CHECK(number(database, "PRAGMA user_version") == 2);
  CHECK(number(database, "SELECT 10 * x + y FROM a") == 35);
  bring_up_to_date(database, steps);
  CHECK(number(database, "SELECT count(*) FROM a") == 1);

  SQLite::Database fresh = writable(folder / "e");
  bring_up_to_date(fresh, steps);
  CHECK(number(fresh, "PRAGMA user_version") == 2);
}

TEST_CASE("a migration that fails changes nothing") {
  const ScratchFolder folder;
  const std::array steps{"CREATE TABLE a (x INTEGER) STRICT", "ALTER TABLE a ADD COLUMN y INTEGER; no SQL at all"};
  SQLite::Database database = writable(folder / "d");
  bring_up_to_date(database, std::span(steps).first(1));
  CHECK_THROWS(bring_up_to_date(database, steps));
  CHECK(number(database, "PRAGMA user_version") == 1);
  CHECK(number(database, "SELECT count(*) FROM pragma_table_info('a')") == 1);
}

TEST_CASE("a newer version is refused with both numbers, and an older one for reading alone") {
  const ScratchFolder folder;
  { Store::open(folder / "s", Store::Mode::create); }
  const auto file = folder / "s" / "tamp.sqlite";
  writable(file).exec("PRAGMA user_version = 999");
  for (const auto mode : {Store::Mode::create, Store::Mode::read}) {
    CHECK_THROWS_AS(Store::open(folder / "s", mode), Error);
    CHECK_THROWS_WITH(Store::open(folder / "s", mode), Contains("newer") && Contains("999") && Contains("tamp.sqlite"));
  }
  writable(file).exec("PRAGMA user_version = 0");
  CHECK_THROWS_WITH(Store::open(folder / "s", Store::Mode::read), Contains("older"));
}

TEST_CASE("the database of another program is left alone") {
  const ScratchFolder folder;
  const auto file = folder / "tamp.sqlite";
  writable(file).exec("CREATE TABLE mail (id INTEGER)");
  for (const auto mode : {Store::Mode::create, Store::Mode::read})
    CHECK_THROWS_WITH(Store::open(folder.path(), mode), Contains("another program"));
  SQLite::Database database = writable(file);
  CHECK(number(database, "SELECT count(*) FROM sqlite_schema") == 1);
}
