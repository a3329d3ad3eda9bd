// The tables of a store, their versions, and the opening of the database file.
#pragma once

#include <SQLiteCpp/Database.h>

#include <filesystem>
#include <span>

namespace tamp {

/// Marks the file as a store ("TAMP"), so that no other database is taken for one (PRAGMA application_id).
inline constexpr int application_id = 0x54414D50;

/// SQL scripts; number i brings a database from version i to i + 1. Released steps never change: a new layout is a new
/// step at the end.
std::span<const char* const> schema_steps();

/// Brings the database to version steps.size() in one transaction. Throws Error, and changes nothing, if its version is
/// newer than that or if it belongs to another program.
void bring_up_to_date(SQLite::Database& database, std::span<const char* const> steps);

/// Opens tamp.sqlite: to write (made if missing, brought up to date) or to read (must exist and be up to date).
/// `network`: the file lies on a network file system, where it does without the write-ahead log. Throws Error or
/// SQLite::Exception.
SQLite::Database open_database(const std::filesystem::path& file, bool writable, bool network = false);

} // namespace tamp
