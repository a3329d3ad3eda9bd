// What a Store is made of: for the source files of the class alone.
#pragma once

#include "engine/base/error.h"
#include "engine/base/mount_kind.h"
#include "store/query.h"
#include "store/schema.h"
#include "store/store.h"

#include <SQLiteCpp/Exception.h>

#include <mutex>

namespace tamp {

struct Store::Parts {
  Parts(std::filesystem::path folder_, bool writable)
      : folder(std::move(folder_)), file(folder / "tamp.sqlite"), network(network_file_system(folder)),
        database(open_database(file, writable, !network.empty())) {}

  std::filesystem::path folder;
  std::filesystem::path file;
  std::string_view network; // the name of the network file system on which the folder lies, if it does
  std::mutex mutex;         // guards all below: statements are not for several threads
  SQLite::Database database;
  Statements statements{database};
  std::function<void(ImportStep)> on_step;

  void reached(ImportStep step) const {
    if (on_step)
      on_step(step);
  }
};

/// Whether an error of SQLite means that its file is damaged.
bool is_damage(const SQLite::Exception& error);

/// What a user can do about an error of SQLite, to go behind its message; empty if that says it all.
std::string advice(const SQLite::Exception& error, const std::filesystem::path& file);

/// Turns what SQLite throws into an Error that names the database.
template <class F>
decltype(auto) with_named_file(const std::filesystem::path& file, F&& f) {
  try {
    return f();
  } catch (const SQLite::Exception& e) {
    const std::string message = "cannot use " + file.string() + ": " + e.what() + advice(e, file);
    if (is_damage(e))
      throw DamagedStore(message);
    throw Error(message);
  }
}

/// Calls f(statements) under the lock of the store.
template <class Parts, class F>
auto with_statements(Parts& parts, F&& f) {
  const std::scoped_lock lock(parts.mutex);
  return with_named_file(parts.file, [&] { return f(parts.statements); });
}

} // namespace tamp
