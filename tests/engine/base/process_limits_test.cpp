// The limits of child processes: wall and CPU time, memory, cancellation; and what a child is said to have used.
#include "engine/base/host.h"
#include "engine/base/process.h"
#include "tests/engine/base/process_helpers.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>
#include <signal.h>

#include <chrono>
#include <thread>

using namespace tamp;
using namespace std::chrono_literals;
using End = ProcessResult::End;

TEST_CASE("An endless child is stopped at its wall limit", "[process]") {
  auto request = shell("sleep 1000");
  request.limits.wall_s = 0.2;
  const auto result = run_process(request);
  CHECK(result.end == End::wall_limit);
  CHECK(result.code == SIGTERM);
  CHECK(result.wall_s >= 0.2);
  CHECK(result.wall_s < 2);
}

TEST_CASE("A child that does not heed SIGTERM is killed after the grace", "[process]") {
  auto request = shell("trap '' TERM; while :; do sleep 0.02; done");
  request.limits.wall_s = 0.2;
  request.grace_s = 0.2;
  const auto result = run_process(request);
  CHECK(result.end == End::wall_limit);
  CHECK(result.code == SIGKILL);
  CHECK(result.wall_s >= 0.4);
}

TEST_CASE("A child may use its grace to leave in order", "[process]") {
  const ScratchFolder folder;
  auto request = shell("trap 'echo tidy; exit 5' TERM; while :; do sleep 0.02; done");
  request.log = folder / "log";
  request.limits.wall_s = 0.3;
  request.grace_s = 10;
  const auto result = run_process(request);
  CHECK(result.end == End::wall_limit);
  CHECK(result.code == 5);
  CHECK_THAT(result.log_tail, Catch::EndsWith("tidy\n")); // The shell may report its sleep first.
  CHECK(result.wall_s < 5);
}

TEST_CASE("A stopped child can still be ended", "[process]") {
  auto request = shell("kill -STOP $$");
  request.limits.wall_s = 0.2;
  CHECK(run_process(request).code == SIGTERM);
}

TEST_CASE("A busy child is stopped at its CPU limit", "[process]") {
  auto request = shell("while :; do :; done");
  request.limits.cpu_s = 0.5; // Rounded up to one second.
  const auto result = run_process(request);
  CHECK(result.end == End::cpu_limit);
  CHECK(result.cpu_s >= 0.5); // The kernel counts in ticks for the limit, so it may strike early.
  CHECK(result.cpu_s < 3);
}

TEST_CASE("A child that ignores the CPU limit's signal is killed by the hard limit", "[process][slow]") {
  auto request = shell("trap '' XCPU; while :; do :; done");
  request.limits.cpu_s = 1;
  request.grace_s = 1;
  const auto result = run_process(request);
  CHECK(result.end == End::cpu_limit);
  CHECK(result.code == SIGKILL);
}

TEST_CASE("CPU time is that of the child and its descendants, not the wall time", "[process]") {
  CHECK(run_process(shell("sleep 0.4")).cpu_s < 0.2);
  auto busy = shell("sh -c 'while :; do :; done'; exit 3");
  busy.limits.cpu_s = 1;
  const auto result = run_process(busy); // The inner shell meets the limit; the outer one lives to tell.
  CHECK(result.end == End::exited);
  CHECK(result.code == 3);
  CHECK(result.cpu_s >= 0.5); // The kernel counts in ticks for the limit, so it may strike early.
}

TEST_CASE("A memory hog fails at its limit and does well without one", "[process]") {
  const ScratchFolder folder;
  ProcessRequest request{.argv = {"dd", "if=/dev/zero", "of=/dev/null", "bs=256M", "count=1"}, .log = folder / "log"};
  request.limits.memory_bytes = 128u << 20;
  const auto limited = run_process(request);
  CHECK(limited.end == End::exited);
  CHECK(limited.code == 1);
  CHECK_THAT(limited.log_tail, Catch::Contains("memory"));
  request.limits.memory_bytes = 0;
  CHECK(run_process(request).succeeded());
}

TEST_CASE("Peak memory is the child's own, however much this process holds", "[process]") {
  const ProcessRequest big{.argv = {"dd", "if=/dev/zero", "of=/dev/null", "bs=200M", "count=10"}};
  const auto check = [&] {
    const auto peak = run_process(big).peak_rss_bytes;
    CHECK(peak >= 200u << 20);
    CHECK(peak < 230u << 20);
    CHECK(run_process(shell("sleep 0.1")).peak_rss_bytes < 20u << 20);
    CHECK(run_process(shell("sleep 0.1")).peak_rss_bytes > 100u << 10);
  };
  check();
  const std::vector<char> ballast(100u << 20, 'x');
  CHECK(peak_rss_bytes() >= ballast.size());
  check();
}

TEST_CASE("Cancellation stops the child, even one requested beforehand", "[process]") {
  std::stop_source source;
  const std::jthread canceller([&] {
    std::this_thread::sleep_for(100ms);
    source.request_stop();
  });
  const auto result = run_process(shell("sleep 1000"), source.get_token());
  CHECK(result.end == End::cancelled);
  CHECK(result.wall_s < 2);
  CHECK(run_process(shell("sleep 1000"), source.get_token()).end == End::cancelled);
}
