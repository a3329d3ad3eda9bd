// Files that are whole or absent: fault injection at every call, readers during writes, kill -9 during everything.
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/base/process.h"
#include "tests/engine/base/failing_file_system.h"
#include "tests/engine/base/process_helpers.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

using namespace tamp;
using namespace std::chrono_literals;
using Call = FailingFileSystem::Call;

namespace {

std::filesystem::path path_of_test() {
  const char* path = std::getenv("TAMP_TEST_PATH");
  REQUIRE(path != nullptr);
  return path;
}

struct Fault {
  Call call;
  int nth;
  bool after_rename;
};

} // namespace

TEST_CASE("What is written is read back, byte by byte", "[files]") {
  const ScratchFolder folder;
  const auto path = folder / "data";
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 1'000'000u}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i)
      bytes[i] = static_cast<char>(i * 31);
    write_atomically(path, bytes);
    CHECK(read_file(path) == bytes);
  }
  CHECK(folder.size() == 1);
}

TEST_CASE("A path without a folder means the present one", "[files]") {
  const ScratchFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  write_atomically("plain", "text");
  std::filesystem::current_path(before);
  CHECK(read_file(folder / "plain") == "text");
}

TEST_CASE("Errors name the path and the reason", "[files]") {
  const ScratchFolder folder;
  CHECK_THROWS_WITH(read_file(folder / "absent"), Catch::Contains("absent: No such file"));
  CHECK_THROWS_WITH(read_file(folder.path()), Catch::Contains("directory"));
  CHECK_THROWS_WITH(write_atomically(folder / "absent" / "x", ""), Catch::Contains("No such file"));
  CHECK_THROWS_AS(publish(folder / "absent", folder / "x"), Error);
  std::filesystem::create_directory(folder / "taken");
  CHECK_THROWS_WITH(write_atomically(folder / "taken", "x"), Catch::Contains("taken: Is a directory"));
  CHECK(folder.size() == 1);
}

TEST_CASE("A fault at any call leaves the old file or the new one, and no temporary", "[files]") {
  const ScratchFolder folder;
  const auto path = folder / "data";
  const int error_number = GENERATE(ENOSPC, EIO);
  const bool published = GENERATE(false, true);
  const auto fault = GENERATE(Fault{Call::open, 1, false}, Fault{Call::write, 1, false}, Fault{Call::fsync, 1, false},
                              Fault{Call::open, 2, false}, Fault{Call::rename, 1, false}, Fault{Call::fsync, 2, true});
  if (published && (fault.call == Call::write || fault.call == Call::open))
    return; // Written by somebody else.

  write_atomically(path, "old");
  const auto temporary = temporary_name(path);
  if (published)
    std::ofstream(temporary) << "new text";
  FailingFileSystem failing(fault.call, fault.nth, error_number);
  {
    const ScopedFileSystem scope(failing);
    const auto reason = "errno " + std::to_string(error_number);
    if (published)
      CHECK_THROWS_WITH(publish(temporary, path), Catch::Contains(reason));
    else
      CHECK_THROWS_WITH(write_atomically(path, "new text"), Catch::Contains(reason));
  }
  CHECK(failing.failed());
  CHECK(read_file(path) == (fault.after_rename ? "new text" : "old"));
  CHECK(folder.size() == 1);
  write_atomically(path, "after");
  CHECK(read_file(path) == "after");
}

TEST_CASE("Interrupted and short writes are continued", "[files]") {
  struct Slow : FileSystem {
    int calls = 0;
    ssize_t write(int fd, const void* data, std::size_t size) override {
      if (++calls % 2 == 1) {
        errno = EINTR;
        return -1;
      }
      return FileSystem::write(fd, data, std::min<std::size_t>(size, 7));
    }
  } slow;
  const ScratchFolder folder;
  const std::string bytes(100, 'b');
  {
    const ScopedFileSystem scope(slow);
    write_atomically(folder / "data", bytes);
  }
  CHECK(slow.calls == 30);
  CHECK(read_file(folder / "data") == bytes);
}

TEST_CASE("A file written by a library is published under its name", "[files]") {
  const ScratchFolder folder;
  const auto temporary = temporary_name(folder / "data.h5");
  std::ofstream(temporary) << "bytes";
  publish(temporary, folder / "data.h5");
  CHECK(read_file(folder / "data.h5") == "bytes");
  CHECK(folder.size() == 1);
}

TEST_CASE("Concurrent readers see the old text or the new one, never half", "[files]") {
  const ScratchFolder folder;
  const auto path = folder / "data";
  const auto text = [](int i) { return std::string(static_cast<std::size_t>(50'000 + i), static_cast<char>('a' + i)); };
  write_atomically(path, text(0));
  std::atomic<bool> done = false;
  std::atomic<int> torn = 0, reads = 0;
  {
    std::vector<std::jthread> readers;
    for (int r = 0; r < 3; ++r)
      readers.emplace_back([&] {
        while (!done) {
          const auto seen = read_file(path);
          const int i = static_cast<int>(seen.size()) - 50'000;
          if (i < 0 || i >= 26 || seen != text(i))
            ++torn;
          ++reads;
        }
      });
    std::vector<std::jthread> writers;
    for (int w = 0; w < 2; ++w)
      writers.emplace_back([&, w] {
        for (int i = 0; i < 60; ++i)
          write_atomically(path, text((2 * i + w) % 26));
      });
    writers.clear();
    done = true;
  }
  CHECK(torn == 0);
  CHECK(reads > 10);
  CHECK(folder.size() == 1);
}

// Run by the next test in a process of its own.
TEST_CASE("Writer to be killed", "[.writer-to-be-killed]") {
  const auto path = path_of_test();
  for (int i = 0;; ++i)
    write_atomically(path, std::string(200'000, static_cast<char>('a' + i % 26)));
}

TEST_CASE("kill -9 during writes leaves a whole file and temporaries that are known as stale", "[files]") {
  const ScratchFolder folder;
  const auto path = folder / "data";
  for (int round = 0; round < 10; ++round) {
    std::filesystem::remove(path);
    auto writer = ChildProcess::start(own_test("[.writer-to-be-killed]", path));
    REQUIRE(eventually([&] { return std::filesystem::exists(path); }));
    std::this_thread::sleep_for(std::chrono::microseconds(700 * round));
    CHECK(stale_temporaries(folder.path()).empty()); // The maker lives.
    ::kill(writer.pid(), SIGKILL);
    writer.wait();
    const auto text = read_file(path);
    REQUIRE(text.size() == 200'000);
    CHECK(text == std::string(text.size(), text.front()));
    const auto stale = stale_temporaries(folder.path());
    CHECK(folder.size() == 1 + stale.size());
    CHECK(remove_stale_temporaries(folder.path()) == stale.size());
    CHECK(folder.size() == 1);
  }
}

TEST_CASE("Temporary names are unique, beside their file, and tell their maker", "[files]") {
  const ScratchFolder folder;
  const auto name = temporary_name(folder / "data.v2.h5");
  CHECK(name.parent_path() == folder.path());
  CHECK(name != temporary_name(folder / "data.v2.h5"));
  CHECK(name.filename().string().starts_with(".data.v2.h5."));
  CHECK(temporary_name(folder / std::string(255, 'n')).filename().string().size() <= 255);

  const auto touch = [](const std::filesystem::path& path) { std::ofstream(path) << "x"; };
  touch(name);
  CHECK(stale_temporaries(folder.path()).empty()); // Ours, and we live.

  // The same name from a process of our number that started at another time: the number was used again.
  auto text = name.string();
  const auto pid = '.' + std::to_string(::getpid()) + '.';
  const auto reused = text.replace(text.rfind(pid), pid.size(), pid + '9');
  touch(reused);
  // Another host's: unknown, so kept for a day.
  const auto foreign = folder / ".data.elsewhere.1.2.3.tamp-tmp";
  const auto old_foreign = folder / ".data.elsewhere.1.2.4.tamp-tmp";
  touch(foreign);
  touch(old_foreign);
  std::filesystem::last_write_time(old_foreign, std::filesystem::file_time_type::clock::now() - 25h);
  // No temporaries at all, whatever they look like.
  touch(folder / "data");
  touch(folder / ".tamp-tmp");
  touch(folder / ".data.tamp-tmp");
  touch(folder / ".data.host.x.2.3.tamp-tmp");
  CHECK(stale_temporaries(folder.path()) == std::vector<std::filesystem::path>{old_foreign, reused});
  CHECK(remove_stale_temporaries(folder.path()) == 2);
  CHECK(std::filesystem::exists(foreign));
  CHECK(std::filesystem::exists(name));
  CHECK(stale_temporaries(folder / "absent").empty());
}

TEST_CASE("A lock excludes a second holder in the same process until it goes", "[files][lock]") {
  const ScratchFolder folder;
  const auto path = folder / "lock";
  auto held = FileLock::try_lock(path);
  REQUIRE(held);
  CHECK_FALSE(FileLock::try_lock(path));
  CHECK_THROWS_WITH(FileLock::lock(path, 0), Catch::Contains("locked by process " + std::to_string(::getpid()) + ' '));
  const double start = steady_seconds();
  CHECK_THROWS_AS(FileLock::lock(path, 0.1), Error);
  CHECK(steady_seconds() - start >= 0.1);

  const FileLock moved = std::move(*held);
  held.reset();
  CHECK_FALSE(FileLock::try_lock(path));
}

TEST_CASE("A lock can be taken again, and a waiting one gets it", "[files][lock]") {
  const ScratchFolder folder;
  const auto path = folder / "lock";
  { const auto first = FileLock::lock(path); }
  CHECK(FileLock::holder(path) == "another process"); // Nobody is named any more.
  auto held = FileLock::try_lock(path);
  REQUIRE(held);
  const std::jthread release([&] {
    std::this_thread::sleep_for(100ms);
    held.reset();
  });
  CHECK_NOTHROW(FileLock::lock(path, 10));
  CHECK_THROWS_AS(FileLock::try_lock(folder / "absent" / "lock"), Error);
}

// Run by the next test in a process of its own: holds the lock, and has a child that must not inherit it.
TEST_CASE("Holder to be killed", "[.holder-to-be-killed]") {
  const auto path = path_of_test();
  const auto lock = FileLock::lock(path);
  const auto child = ChildProcess::start({.argv = {"sleep", "1000"}});
  write_atomically(path.string() + ".held", std::to_string(child.pid()));
  for (;;)
    ::pause();
}

TEST_CASE("A lock excludes another process, names it, and is free when it is killed", "[files][lock]") {
  const ScratchFolder folder;
  const auto path = folder / "lock";
  auto holder = ChildProcess::start(own_test("[.holder-to-be-killed]", path));
  const pid_t pid = holder.pid();
  REQUIRE(eventually([&] { return std::filesystem::exists(folder / "lock.held"); }));
  CHECK_FALSE(FileLock::try_lock(path));
  CHECK_THROWS_WITH(FileLock::lock(path, 0), Catch::Contains("process " + std::to_string(pid) + " on host "));
  ::kill(pid, SIGKILL);
  CHECK(holder.wait().code == SIGKILL);
  CHECK(FileLock::try_lock(path));
}
