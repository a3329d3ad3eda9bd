// What a run shows on a terminal and elsewhere, and what Ctrl-C asks for.
#include "campaigns/cli/interrupt.h"
#include "campaigns/cli/progress.h"
#include "tests/campaigns/cli/tamp_command.h"
#include "tests/engine/schedule/mock_run.h"

#include <catch2/catch.hpp>

#include <csignal>
#include <cstdio>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

namespace {

/// What Progress writes about two packings, one of which fails, and a metric.
std::string shown(bool terminal) {
  const ScratchFolder scratch;
  Plan plan = mock_plan("a", 2, 1); // items: 0 (1), 2 (3)
  for (PlannedJob& job : plan.jobs)
    job.label = "method";
  const std::vector<Plan> plans{plan};
  const Agenda agenda = make_agenda(plans, kNothingKnown);
  std::FILE* file = std::fopen((scratch / "shown").c_str(), "w");
  {
    cli::Progress progress(file, terminal, 2);
    progress.opened(agenda);
    Record record;
    record.outcome = Outcome::ok;
    record.measures = {{.name = "N", .value = 123}};
    progress.started(agenda.items[0]);
    progress.finished(agenda.items[0], record);
    record.kind = JobKind::metric;
    progress.started(agenda.items[1]);
    progress.finished(agenda.items[1], record);
    record.kind = JobKind::generation;
    record.outcome = Outcome::failed;
    record.reason = "it broke";
    progress.started(agenda.items[2]);
    progress.finished(agenda.items[2], record);
    progress.barred(agenda.items[3]);
    if (terminal) // the ticker redraws twice a second
      wait_until([&] {
        std::fflush(file);
        return read_file(scratch / "shown").find("4 of 4 jobs done") != std::string::npos;
      });
  }
  std::fclose(file);
  return read_file(scratch / "shown");
}

} // namespace

TEST_CASE("elsewhere than on a terminal, progress is plain lines") {
  const std::string text = shown(false);
  CHECK_THAT(text, Contains("[1/4] method, replicate 0: ok, N = 123") &&
                       Contains("[3/4] method, replicate 0: failed: it broke"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 2);
  CHECK(text.find('\r') == std::string::npos);
}

TEST_CASE("on a terminal, one line is updated in place, and failures stay above it") {
  const std::string text = shown(true);
  CHECK_THAT(text,
             Contains("failed: it broke\n") && Contains("4 of 4 jobs done, 0 running, 1 not ok") && Contains("about "));
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
  CHECK(text.ends_with("\r\x1b[K"));
}

TEST_CASE("the first signal asks for a stop, the second would end the program") {
  for (const int signal : {SIGINT, SIGTERM}) {
    const cli::Interrupt interrupt;
    CHECK_FALSE(interrupt.token().stop_requested());
    std::raise(signal);
    CHECK(wait_until([&] { return interrupt.token().stop_requested(); }));
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    CHECK(now.sa_handler == SIG_DFL);
  }
}
