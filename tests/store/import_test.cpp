// Imports of results: complete, damaged, repeated, and cut off by kill -9 at every step.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "store/store.h"
#include "tests/engine/base/failing_file_system.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/store/examples.h"

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

using namespace tamp;
using Catch::Matchers::Contains;

namespace fs = std::filesystem;

namespace {

struct Result {
  Record record;
  fs::path json, packing;
};

/// A store with one result waiting in incoming/.
Result waiting_result(const fs::path& folder, std::int64_t replicate = 0) {
  const Store store = Store::open(folder, Store::Mode::create);
  const Record record = leave_result(store.incoming(), example_record(replicate), example_packing(2, 50));
  return {record, store.incoming() / (record.key + ".json"), store.incoming() / (record.key + ".h5")};
}

/// Imports in a child process that is killed at `step`; true if it was.
bool import_killed_at(ImportStep step, const fs::path& folder, const Result& result) {
  const pid_t child = ::fork();
  if (child == 0) {
    Store store = Store::open(folder, Store::Mode::create);
    store.on_import_step([&](ImportStep reached) {
      if (reached == step)
        ::kill(::getpid(), SIGKILL);
    });
    store.import_result(result.json, result.packing);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

/// No row without its packing: every record that names one can read it, checked by its digest.
void check_consistent(const Store& store) {
  for (const auto& [key, outcome] : store.outcomes()) {
    const auto record = store.find(key);
    if (!record->packing_file.empty())
      CHECK(store.read_packing(key).count() == 50);
  }
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

} // namespace

TEST_CASE("an import moves the packing, keeps the record and clears incoming") {
  const ScratchFolder folder;
  const Result result = waiting_result(folder.path());
  Store store = Store::open(folder.path(), Store::Mode::create);
  const Record record =
      store.import_result(result.json, result.packing, [](Record& r) { r.timing.process_wall_s = 12.5; });
  CHECK(record.packing_file == "packings/" + record.key.substr(0, 2) + "/" + record.key + ".h5");
  CHECK(record.timing.process_wall_s == 12.5);
  CHECK(text_of(store.find(record.key).value()) == text_of(record));
  CHECK(store.read_packing(record.key).positions == example_packing(2, 50).positions);
  CHECK(read_packing_label(store.packing_path(record.key)).key == record.key);
  CHECK(files_in(store.incoming()) == 0);
}

TEST_CASE("a result without a packing needs no packing file") {
  const ScratchFolder folder;
  Store store = Store::open(folder.path(), Store::Mode::create);
  Record record = example_record(0);
  record.outcome = Outcome::did_not_converge;
  write_record(store.incoming() / "r.json", record);
  store.import_result(store.incoming() / "r.json", store.incoming() / "r.h5");
  CHECK(store.outcome(record.key) == Outcome::did_not_converge);
  CHECK_THROWS_WITH(store.read_packing(record.key), Contains("no packing"));
}

TEST_CASE("killed at any step, an import is finished by the next process") {
  for (const ImportStep step : {ImportStep::verified, ImportStep::packing_moved, ImportStep::row_written,
                                ImportStep::committed, ImportStep::done}) {
    for (const bool by_sweep : {true, false}) {
      INFO("step " << static_cast<int>(step) << ", finished by " << (by_sweep ? "a sweep" : "a repeated import"));
      const ScratchFolder folder;
      const Result result = waiting_result(folder.path());
      REQUIRE(import_killed_at(step, folder.path(), result));

      Store store = Store::open(folder.path(), Store::Mode::create);
      check_consistent(store);
      CHECK(store.has(result.record.key) == (step >= ImportStep::committed));
      if (by_sweep) {
        const Sweep sweep = store.sweep_incoming();
        CHECK(sweep.rejected.empty());
        CHECK(sweep.imported.size() == (step == ImportStep::done ? 0 : 1));
      } else if (step != ImportStep::done) {
        store.import_result(result.json, result.packing);
      }
      CHECK(store.attempts(result.record.key).size() == 1);
      CHECK(store.outcome(result.record.key) == Outcome::ok);
      check_consistent(store);
      CHECK(files_in(store.incoming()) == 0);
    }
  }
}

TEST_CASE("a result that did not end well is not counted twice after a kill") {
  const ScratchFolder folder;
  Store store = Store::open(folder.path(), Store::Mode::create);
  Record record = example_record(0);
  record.outcome = Outcome::time_limited;
  record.reason = "3600 s";
  const Result result{record, store.incoming() / (record.key + ".json"), store.incoming() / (record.key + ".h5")};
  write_record(result.json, record);
  REQUIRE(import_killed_at(ImportStep::committed, folder.path(), result));
  CHECK(store.sweep_incoming().imported.size() == 1);
  CHECK(store.attempts(record.key).size() == 1);
}

TEST_CASE("a failing disk stops an import without harm, and it can be repeated") {
  using Call = FailingFileSystem::Call;
  for (const Call call : {Call::open, Call::fsync, Call::rename}) {
    for (int nth = 1; nth < 10; ++nth) {
      const ScratchFolder folder;
      const Result result = waiting_result(folder.path());
      Store store = Store::open(folder.path(), Store::Mode::create);
      bool has_failed = false;
      {
        FailingFileSystem failing(call, nth, EIO);
        const ScopedFileSystem scope(failing);
        try {
          store.import_result(result.json, result.packing);
        } catch (const Error&) {
          has_failed = true;
        }
        REQUIRE(has_failed == failing.failed());
      }
      check_consistent(store);
      if (!has_failed)
        break;
      CHECK_FALSE(store.has(result.record.key));
    }
  }
}

TEST_CASE("damaged results are refused and stay; a sweep removes them and says why") {
  const ScratchFolder folder;
  Store store = Store::open(folder.path(), Store::Mode::create);
  const Result a = waiting_result(folder.path(), 0); // a packing that is not the record's
  std::ofstream(a.packing, std::ios::app) << "x";
  const Result b = waiting_result(folder.path(), 1); // no packing
  fs::remove(b.packing);
  const Result c = waiting_result(folder.path(), 2); // half a record
  fs::resize_file(c.json, 100);
  Result d = waiting_result(folder.path(), 3); // a key that is not its content's
  d.record.canonical += " ";
  write_record(d.json, d.record);
  const Result e = waiting_result(folder.path(), 4); // sound

  CHECK_THROWS_WITH(store.import_result(a.json, a.packing), Contains("SHA-256"));
  CHECK_THROWS_WITH(store.import_result(b.json, b.packing), Contains("missing"));
  CHECK_THROWS_WITH(store.import_result(c.json, c.packing), Contains("not a whole record"));
  CHECK_THROWS_WITH(store.import_result(d.json, d.packing), Contains("canonical"));
  CHECK(fs::exists(a.json));
  CHECK(store.outcomes().empty());

  const Sweep sweep = store.sweep_incoming();
  CHECK(sweep.rejected.size() == 4);
  REQUIRE(sweep.imported.size() == 1);
  CHECK(sweep.imported[0].key == e.record.key);
  CHECK(store.finished() == std::vector{e.record.key});
  CHECK(files_in(store.incoming()) == 0);
  check_consistent(store);
}

TEST_CASE("a sweep removes what a killed child left half-made, and keeps logs") {
  const ScratchFolder folder;
  Store store = Store::open(folder.path(), Store::Mode::create);
  // A packing without its record, and the temporary of a process that runs no more.
  write_packing(store.incoming() / "abc.h5", example_packing(2, 5), {});
  const pid_t child = ::fork();
  if (child == 0) {
    std::ofstream(temporary_name(store.incoming() / "def.h5")) << "half";
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
  std::ofstream(store.incoming() / "abc.log") << "text";
  CHECK(store.sweep_incoming().removed == 2);
  CHECK(files_in(store.incoming()) == 1);
}

TEST_CASE("a key that gives other bytes the second time is an error") {
  const ScratchFolder folder;
  Store store = Store::open(folder.path(), Store::Mode::create);
  const Result first = waiting_result(folder.path());
  store.import_result(first.json, first.packing);
  const Result again = waiting_result(folder.path());
  CHECK_NOTHROW(store.import_result(again.json, again.packing));
  leave_result(store.incoming(), example_record(0), example_packing(2, 50, "another"));
  CHECK_THROWS_WITH(store.import_result(first.json, first.packing), Contains("not reproducible"));
  CHECK(store.read_packing(first.record.key).positions == example_packing(2, 50).positions);
}

TEST_CASE("a packing damaged after its import is noticed when it is read") {
  const ScratchFolder folder;
  Store store = Store::open(folder.path(), Store::Mode::create);
  const Result result = waiting_result(folder.path());
  store.import_result(result.json, result.packing);
  const fs::path path = store.packing_path(result.record.key);
  {
    std::fstream bytes(path, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(fs::file_size(path)) / 2);
    bytes << "damage";
  }
  CHECK_THROWS_WITH(store.read_packing(result.record.key), Contains("damaged") && Contains(path.string()));
  fs::remove(path);
  CHECK_THROWS_AS(store.read_packing(result.record.key), Error);
}
