// What becomes of child processes that end well, badly, or not at all.
#include "engine/base/error.h"
#include "engine/base/host.h"
#include "engine/schedule/process_executor.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <thread>

using namespace tamp;

namespace {

Task task_of(double wall_s = 20) {
  Task task;
  task.planned.job.scene.size = {20};
  task.planned.job.scene.psd.law = Law::monodisperse;
  task.planned.job.scene.psd.radius = 1;
  task.planned.job.scene = completed(task.planned.job.scene);
  task.planned.key = job_key(task.planned.job);
  task.run.wall_s = wall_s;
  return task;
}

/// Runs a shell script in place of a job.
std::optional<Record> run_script(const std::string& script, const Task& task, std::stop_token stop = {},
                                 std::optional<Record> left = {}) {
  const ScratchFolder scratch;
  Provenance origin;
  origin.commit = "abc";
  ProcessExecutor executor(
      [&](const Task&) {
        return ChildJob{.argv = {"/bin/sh", "-c", script}, .log = scratch / "log", .collect = [&] { return left; }};
      },
      origin);
  return executor.run(task, std::nullopt, std::move(stop));
}

} // namespace

TEST_CASE("the record that a child leaves counts, with the figures of its process") {
  const Task task = task_of();
  Record left = blank_record(task.planned, {});
  left.outcome = Outcome::ok;
  left.timing.wall_s = 0.125;
  const std::optional<Record> record = run_script("exit 0", task, {}, left);
  REQUIRE(record);
  CHECK(record->outcome == Outcome::ok);
  CHECK(record->timing.wall_s == 0.125);
  CHECK(record->timing.mode == TimingMode::shared);
  CHECK(record->timing.process_wall_s > 0);
  CHECK(record->timing.peak_rss_bytes > 0);
}

TEST_CASE("a child that leaves no record has failed, and the reason says how") {
  const Task task = task_of();
  const std::optional<Record> record = run_script("echo the disk is on fire; exit 3", task);
  REQUIRE(record);
  CHECK(record->outcome == Outcome::failed);
  CHECK_THAT(record->reason, Catch::Contains("exited with code 3") && Catch::Contains("the disk is on fire"));
  CHECK(record->key == task.planned.key);
  CHECK(record->canonical == canonical(task.planned.job));
  CHECK(record->provenance.commit == "abc");
  CHECK(record->provenance.start_utc <= record->provenance.end_utc);
  CHECK_FALSE(record->provenance.start_utc.empty());

  CHECK(run_script("exit 0", task)->outcome == Outcome::failed); // even if it left politely
}

TEST_CASE("a crash names its signal") {
  for (const auto& [signal, name] : {std::pair{"SEGV", "SIGSEGV"}, {"ABRT", "SIGABRT"}, {"FPE", "SIGFPE"}}) {
    const std::optional<Record> record = run_script(std::string("kill -") + signal + " $$", task_of());
    REQUIRE(record);
    CHECK(record->outcome == Outcome::crashed);
    CHECK_THAT(record->reason, Catch::Contains(name));
  }
}

TEST_CASE("a child that runs out of memory is memory-limited, whether it notices or is killed") {
  CHECK(run_script("exit " + std::to_string(kExitOutOfMemory), task_of())->outcome == Outcome::memory_limited);

  ProcessResult killed;
  killed.end = ProcessResult::End::signalled;
  killed.code = SIGKILL;
  RunSettings run;
  run.memory_mb = 1000;
  killed.peak_rss_bytes = 900'000'000;
  CHECK(judge_child(killed, run).outcome == Outcome::memory_limited);
}

TEST_CASE("a small child killed by hand has crashed, so that it is tried again") {
  const std::optional<Record> record = run_script("kill -KILL $$", task_of());
  CHECK(record->outcome == Outcome::crashed);
  CHECK_THAT(record->reason, Catch::Contains("SIGKILL"));
}

TEST_CASE("a child that cannot even be started is an outcome too") {
  ProcessExecutor executor([](const Task&) { return ChildJob{.argv = {"/no/such/program"}, .log = {}, .collect = {}}; },
                           {});
  const std::optional<Record> record = executor.run(task_of(), std::nullopt, {});
  REQUIRE(record);
  CHECK(record->outcome == Outcome::failed);
  CHECK_THAT(record->reason, Catch::Contains("/no/such/program"));
}

TEST_CASE("a budget below the size of the program itself is one of memory too") {
  RunSettings run;
  run.memory_mb = 1;
  ProcessResult result;
  SECTION("ended by the kernel while it loads the program") {
    result.end = ProcessResult::End::signalled;
    result.code = SIGSEGV;
  }
  SECTION("given up by the loader") {
    result.code = 127;
  }
  CHECK(judge_child(result, run).outcome == Outcome::memory_limited);
  run.memory_mb = 4096;
  CHECK_FALSE(leaves_packing(judge_child(result, run).outcome));
  CHECK(judge_child(result, run).outcome != Outcome::memory_limited);
}

TEST_CASE("a child that takes too long is time-limited") {
  const double start = steady_seconds();
  const std::optional<Record> record = run_script("exec sleep 60", task_of(0.1));
  REQUIRE(record);
  CHECK(record->outcome == Outcome::time_limited);
  CHECK_THAT(record->reason, Catch::Contains("0.1 s"));
  CHECK(steady_seconds() - start < 10);
}

TEST_CASE("a cancelled child ends at once and leaves nothing to record") {
  std::stop_source stop;
  const std::jthread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop.request_stop();
  });
  const double start = steady_seconds();
  CHECK_FALSE(run_script("exec sleep 60", task_of(), stop.get_token()));
  CHECK(steady_seconds() - start < 10);
}

TEST_CASE("an exclusive job is pinned to its core and says so") {
  const Task task = task_of();
  const ScratchFolder scratch;
  const int core = usable_cores().back();
  ProcessExecutor executor(
      [&](const Task&) {
        return ChildJob{.argv = {"/bin/sh", "-c", "grep Cpus_allowed_list /proc/self/status; exit 1"},
                        .log = scratch / "log",
                        .collect = [] { return std::nullopt; }};
      },
      {});
  const std::optional<Record> record = executor.run(task, core, {});
  REQUIRE(record);
  CHECK(record->timing.mode == TimingMode::exclusive);
  CHECK_THAT(record->reason, Catch::EndsWith("Cpus_allowed_list:\t" + std::to_string(core)));
}

TEST_CASE("the record of another job is a fault of the program, not an outcome") {
  Record other = blank_record(task_of().planned, {});
  other.key = "another";
  CHECK_THROWS_AS(run_script("exit 0", task_of(), {}, other), Error);
}
