// What a Store is made of: for the source files of the class alone.
#pragma once

#include "engine/base/error.h"
#include "store/query.h"
#include "store/schema.h"
#include "store/store.h"

#include <SQLiteCpp/Exception.h>

#include <mutex>

namespace tamp {

struct Store::Parts {
  Parts(std::filesystem::path folder_, bool writable)
      : folder(std::move(folder_)), file(folder / "tamp.sqlite"), database(open_database(file, writable)) {}

  std::filesystem::path folder;
  std::filesystem::path file;
  std::mutex mutex; // guards all below: statements are not for several threads
  SQLite::Database database;
  Statements statements{database};
  std::function<void(ImportStep)> on_step;

  void reached(ImportStep step) const {
    if (on_step)
      on_step(step);
  }
};

/// Turns what SQLite throws into an Error that names the database.
template <class F>
decltype(auto) with_named_file(const std::filesystem::path& file, F&& f) {
  try {
    return f();
  } catch (const SQLite::Exception& e) {
    constexpr int damaged = 11;        // SQLITE_CORRUPT
    constexpr int not_a_database = 26; // SQLITE_NOTADB
    const int code = e.getErrorCode();
    const bool is_broken = code == damaged || code == not_a_database;
    throw Error("cannot use " + file.string() + ": " + e.what() +
                (is_broken ? "; the file is damaged: move it away and start a new store, or restore a copy" : ""));
  }
}

/// Calls f(statements) under the lock of the store.
template <class Parts, class F>
auto with_statements(Parts& parts, F&& f) {
  const std::scoped_lock lock(parts.mutex);
  return with_named_file(parts.file, [&] { return f(parts.statements); });
}

} // namespace tamp
