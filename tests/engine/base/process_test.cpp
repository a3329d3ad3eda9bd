// Child processes: every way to start and end, and that nothing is left behind (processes, zombies, descriptors).
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/base/process.h"
#include "tests/engine/base/process_helpers.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

using namespace tamp;
using namespace std::chrono_literals;
using End = ProcessResult::End;

TEST_CASE("A child that exits hands over its code and its output", "[process]") {
  const ScratchFolder folder;
  auto request = shell("echo out; echo err >&2; exit 7");
  request.log = folder / "log";
  const auto result = run_process(request);
  CHECK(result.end == End::exited);
  CHECK(result.code == 7);
  CHECK_FALSE(result.succeeded());
  CHECK(result.log_tail == "out\nerr\n");
  CHECK(read_file(request.log) == "out\nerr\n");
  CHECK(result.wall_s > 0);
  CHECK(result.wall_s < 10);

  request.argv.back() = "echo anew";
  CHECK(run_process(request).succeeded());
  CHECK(read_file(request.log) == "anew\n");
}

TEST_CASE("A program without a slash is found in PATH, its arguments are passed unchanged", "[process]") {
  const ScratchFolder folder;
  const ProcessRequest request{.argv = {"printf", "%s|", "a b", "", "$HOME"}, .log = folder / "log"};
  CHECK(run_process(request).log_tail == "a b||$HOME|");
}

TEST_CASE("A crash is a result that names its signal", "[process]") {
  const auto result = run_process(shell("kill -SEGV $$"));
  CHECK(result.end == End::signalled);
  CHECK(result.code == SIGSEGV);
}

TEST_CASE("What cannot be started is an error with its reason", "[process]") {
  const ScratchFolder folder;
  const auto descriptors = open_descriptors();
  std::ofstream(folder / "data") << "no program";
  CHECK_THROWS_WITH(run_process({.argv = {(folder / "absent").string()}}), Catch::Contains("absent: No such file"));
  CHECK_THROWS_WITH(run_process({.argv = {"tamp-no-such-program"}}), Catch::Contains("tamp-no-such-program"));
  CHECK_THROWS_WITH(run_process({.argv = {(folder / "data").string()}}), Catch::Contains("Permission denied"));
  CHECK_THROWS_WITH(run_process({.argv = {"/bin/true"}, .log = folder / "absent" / "log"}),
                    Catch::Contains("absent/log: No such file"));
  CHECK_THROWS_WITH(run_process({.argv = {"/bin/true"}, .core = 1023}), Catch::Contains("pin to its core"));
  CHECK_THROWS_AS(run_process({.argv = {"/bin/true"}, .core = -1}), Error);
  CHECK_THROWS_AS(run_process({}), Error);
  CHECK(open_descriptors() == descriptors);
  CHECK_FALSE(has_children());
}

TEST_CASE("More output than a pipe holds does not block; the tail is whole last lines", "[process]") {
  const ScratchFolder folder;
  auto request = shell("seq 1 200000");
  request.log = folder / "log";
  const auto result = run_process(request);
  CHECK(result.succeeded());
  CHECK(std::filesystem::file_size(request.log) > 1u << 20);
  CHECK(result.log_tail.size() <= 4096);
  CHECK(result.log_tail.size() > 4000);
  std::istringstream lines(result.log_tail);
  int first = 0, last = 0;
  lines >> first;
  CHECK(first > 199'000);
  for (int number = 0; lines >> number; last = number)
    CHECK(number > first);
  CHECK(last == 200'000);
}

TEST_CASE("A long last line is cut, not lost", "[process]") {
  const ScratchFolder folder;
  auto request = shell("head -c 10000 /dev/zero | tr '\\0' x");
  request.log = folder / "log";
  CHECK(run_process(request).log_tail == std::string(4096, 'x'));
}

TEST_CASE("Two hundred children at once all end as they should, and nothing leaks", "[process]") {
  run_process(shell("true"));
  const auto descriptors = open_descriptors();
  {
    std::vector<ChildProcess> children;
    for (int i = 0; i < 200; ++i)
      children.push_back(ChildProcess::start(shell("sleep 0.2; exit " + std::to_string(i))));
    for (int i = 0; i < 200; ++i)
      CHECK(children[static_cast<std::size_t>(i)].wait().code == i);
  }
  CHECK(open_descriptors() == descriptors);
  CHECK_FALSE(has_children());
}

TEST_CASE("Children may be started and awaited from many threads at once", "[process]") {
  std::vector<int> codes(16, -1);
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 16; ++t)
      threads.emplace_back([t, &code = codes[static_cast<std::size_t>(t)]] {
        code = 0;
        for (int i = 0; i < 5; ++i)
          code += run_process(shell("exit " + std::to_string(t))).code;
      });
  }
  for (int t = 0; t < 16; ++t)
    CHECK(codes[static_cast<std::size_t>(t)] == 5 * t);
  CHECK_FALSE(has_children());
}

TEST_CASE("Grandchildren go with the group, whether it is stopped or ends by itself", "[process]") {
  const ScratchFolder folder;
  const auto file = folder / "pid";
  const auto script = "sh -c 'trap \"\" TERM; echo $$ end > " + file.string() + "; while :; do sleep 0.05; done' & ";
  SECTION("stopped") {
    auto request = shell(script + "wait");
    request.limits.wall_s = 0.5;
    CHECK(run_process(request).end == End::wall_limit);
  }
  SECTION("ended") {
    CHECK(run_process(shell(script + "while [ ! -s " + file.string() + " ]; do sleep 0.02; done")).succeeded());
  }
  SECTION("abandoned") {
    const auto child = ChildProcess::start(shell(script + "wait"));
    CHECK(awaited_pid(file) > 0);
  }
  const pid_t grandchild = awaited_pid(file);
  REQUIRE(grandchild > 0);
  CHECK(eventually([&] { return is_dead(grandchild); }));
}

TEST_CASE("An object that goes, or is assigned to, ends its child and reaps it", "[process]") {
  auto first = ChildProcess::start(shell("sleep 1000"));
  const pid_t first_pid = first.pid();
  pid_t second_pid = -1;
  {
    auto second = ChildProcess::start(shell("sleep 1000"));
    second_pid = second.pid();
    CHECK(::kill(first_pid, 0) == 0);
    first = std::move(second);
    CHECK(::kill(first_pid, 0) != 0);
  }
  CHECK(::kill(second_pid, 0) == 0);
  CHECK(::getpgid(second_pid) == second_pid);
  first.wait(std::stop_token(([] {
    std::stop_source source;
    source.request_stop();
    return source.get_token();
  })()));
  CHECK(first.pid() == -1);
  CHECK_THROWS_AS(first.wait(), std::logic_error);
  CHECK_FALSE(has_children());
}

TEST_CASE("A child outlives the thread that started it", "[process]") {
  std::optional<ChildProcess> child;
  std::thread([&] { child = ChildProcess::start(shell("sleep 0.3; exit 9")); }).join();
  const auto result = child->wait();
  CHECK(result.end == End::exited);
  CHECK(result.code == 9);
}

// Run by the next test in a process of its own: starts a child in a group of its own and waits for ever.
TEST_CASE("Parent to be killed", "[.parent-to-be-killed]") {
  const char* file = std::getenv("TAMP_TEST_PATH");
  REQUIRE(file != nullptr);
  run_process(shell("echo $$ end > " + std::string(file) + "; exec sleep 1000"));
}

TEST_CASE("A child dies with its parent, even by kill -9", "[process]") {
  const ScratchFolder folder;
  const auto file = folder / "pid";
  auto parent = ChildProcess::start(own_test("[.parent-to-be-killed]", file));
  const pid_t child = awaited_pid(file);
  REQUIRE(child > 0);
  CHECK_FALSE(is_dead(child));
  ::kill(parent.pid(), SIGKILL);
  const auto result = parent.wait();
  CHECK(result.end == End::signalled);
  CHECK(result.code == SIGKILL);
  CHECK(eventually([&] { return is_dead(child); }));
}

TEST_CASE("The environment is the caller's with additions and replacements", "[process]") {
  const ScratchFolder folder;
  ::setenv("TAMP_TEST_KEPT", "kept", 1);
  ::setenv("TAMP_TEST_REPLACED", "old", 1);
  auto request = shell("echo $TAMP_TEST_KEPT $TAMP_TEST_REPLACED $TAMP_TEST_ADDED; env | grep -c TAMP_TEST_REPLACED");
  request.environment = {{"TAMP_TEST_REPLACED", "new"}, {"TAMP_TEST_ADDED", "a=b"}};
  request.log = folder / "log";
  CHECK(run_process(request).log_tail == "kept new a=b\n1\n");
}

TEST_CASE("A child runs on the core it was given, and on all others without one", "[process]") {
  const ScratchFolder folder;
  ProcessRequest request{.argv = {"nproc"}, .log = folder / "log"};
  const auto cores = usable_cores();
  CHECK(run_process(request).log_tail == std::to_string(cores.size()) + '\n');
  request.core = cores.back();
  CHECK(run_process(request).log_tail == "1\n");
  request.argv = {"sed", "-n", "s/^Cpus_allowed_list:[[:space:]]*//p", "/proc/self/status"};
  CHECK(run_process(request).log_tail == std::to_string(cores.back()) + '\n');
}

TEST_CASE("A child inherits no descriptor, no blocked and no ignored signal, no terminal input", "[process]") {
  const ScratchFolder folder;
  const FileDescriptor inheritable(::open("/dev/null", O_RDONLY)); // Without O_CLOEXEC, as some libraries do.
  sigset_t blocked, before;
  ::sigemptyset(&blocked);
  ::sigaddset(&blocked, SIGTERM);
  ::pthread_sigmask(SIG_BLOCK, &blocked, &before);
  const auto handler = ::signal(SIGUSR1, SIG_IGN);
  ProcessRequest request{.argv = {"ls", "/proc/self/fd"}, .log = folder / "log"};
  CHECK(run_process(request).log_tail == "0\n1\n2\n3\n"); // 3 is the folder that ls reads.
  request.argv = {"grep", "-E", "^Sig(Blk|Ign|Cgt)", "/proc/self/status"};
  CHECK_THAT(run_process(request).log_tail, Catch::Contains("SigBlk:\t0000000000000000\nSigIgn:\t0000000000000000"));
  request.argv = {"wc", "-c"};
  CHECK(run_process(request).log_tail == "0\n");
  ::signal(SIGUSR1, handler);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}
