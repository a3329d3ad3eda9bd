// The rules of the run, one step at a time.
#include "engine/schedule/dispatcher.h"
#include "tests/engine/schedule/mock_run.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr std::uint64_t kMb = 1'000'000;

Agenda agenda_of(const std::vector<Plan>& plans) {
  return make_agenda(plans, kNothingKnown);
}

} // namespace

TEST_CASE("shared jobs fill the cores and no more") {
  const Agenda agenda = agenda_of({mock_plan("a", 5, 0)});
  Dispatcher dispatcher(agenda, {.cores = 3, .memory_bytes = 100 * kMb});
  CHECK(dispatcher.start() == std::vector<std::size_t>{0, 1, 2});
  CHECK(dispatcher.start().empty());
  CHECK(dispatcher.finish(1, true).empty());
  CHECK(dispatcher.start() == std::vector<std::size_t>{3});
}

TEST_CASE("memory is shared out like cores") {
  Plan plan = mock_plan("a", 4, 0);
  plan.run.memory_mb = 40;
  const Agenda agenda = agenda_of({plan});
  Dispatcher dispatcher(agenda, {.cores = 8, .memory_bytes = 100 * kMb});
  CHECK(dispatcher.start() == std::vector<std::size_t>{0, 1});
  dispatcher.finish(0, true);
  CHECK(dispatcher.start() == std::vector<std::size_t>{2});
}

TEST_CASE("a job that wants more memory than there is runs alone") {
  Plan large = mock_plan("large", 1, 0);
  large.run.memory_mb = 1'000'000;
  const Agenda agenda = agenda_of({mock_plan("a", 1, 0), large, mock_plan("b", 1, 0)});
  Dispatcher dispatcher(agenda, {.cores = 8, .memory_bytes = 100 * kMb});
  CHECK(dispatcher.start() == std::vector<std::size_t>{0}); // and the small last one does not overtake
  dispatcher.finish(0, true);
  CHECK(dispatcher.start() == std::vector<std::size_t>{1});
  dispatcher.finish(1, true);
  CHECK(dispatcher.start() == std::vector<std::size_t>{2});
}

TEST_CASE("an exclusive job waits for an empty machine and its metrics come before the next one") {
  Plan plan = mock_plan("a", 2, 2); // items: 0 (1 2), 3 (4 5)
  plan.run.timing = TimingMode::exclusive;
  const Agenda agenda = agenda_of({plan});
  Dispatcher dispatcher(agenda, {.cores = 2, .memory_bytes = 100 * kMb});
  CHECK(dispatcher.start() == std::vector<std::size_t>{0});
  dispatcher.finish(0, true);
  CHECK(dispatcher.start() == std::vector<std::size_t>{1, 2});
  dispatcher.finish(1, true);
  CHECK(dispatcher.start().empty()); // one core is free, one metric still runs
  dispatcher.finish(2, true);
  CHECK(dispatcher.start() == std::vector<std::size_t>{3});
}

TEST_CASE("all that stands on a packing that was not made is barred") {
  Plan plan = mock_plan("a", 1, 1); // items: 0 (1), child 2 (3), grandchild 4 (5)
  plan.jobs.push_back(mock_job("child", "a0"));
  plan.jobs.push_back(mock_job("grandchild", "child"));
  const Agenda agenda = agenda_of({plan});
  Dispatcher dispatcher(agenda, {.cores = 2, .memory_bytes = 100 * kMb});
  CHECK(dispatcher.start() == std::vector<std::size_t>{0});
  std::vector<std::size_t> barred = dispatcher.finish(0, false);
  std::sort(barred.begin(), barred.end());
  CHECK(barred == std::vector<std::size_t>{1, 2, 3, 4, 5});
  CHECK(dispatcher.start().empty());
}
