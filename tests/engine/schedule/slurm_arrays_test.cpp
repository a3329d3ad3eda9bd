// Job arrays: everything is handed in once, alike jobs together, parents before children, none too large.
#include "engine/schedule/slurm.h"
#include "tests/engine/schedule/mock_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>
#include <set>

using namespace tamp;

namespace {

/// Tasks with these budgets; each starts from the packing of the one whose index is given, -1 for none.
Agenda agenda_of(const std::vector<std::pair<double, int>>& wall_and_parent) {
  Agenda agenda;
  for (std::size_t i = 0; i < wall_and_parent.size(); ++i) {
    Task task;
    task.planned.key = "key" + std::to_string(i);
    task.run.wall_s = wall_and_parent[i].first;
    if (const int parent = wall_and_parent[i].second; parent >= 0)
      task.planned.job.parent = "key" + std::to_string(parent);
    agenda.tasks.push_back(task);
  }
  return agenda;
}

std::vector<std::size_t> all_of(const Agenda& agenda) {
  std::vector<std::size_t> tasks(agenda.tasks.size());
  std::iota(tasks.begin(), tasks.end(), std::size_t{0});
  return tasks;
}

} // namespace

TEST_CASE("every task stands in one element, beside its like, after its parent") {
  std::vector<std::pair<double, int>> tasks;
  for (int i = 0; i < 40; ++i)
    tasks.emplace_back(i % 3 == 0 ? 100 : 7, i >= 20 ? i - 20 : -1);
  tasks.emplace_back(7, 39); // a grandchild
  const Agenda agenda = agenda_of(tasks);
  ClusterProfile profile;
  profile.bundle_wall_s = 21;
  const auto arrays = arrange(agenda, all_of(agenda), profile, 4);

  std::set<std::size_t> seen;
  std::map<std::string, std::size_t> array_of;
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    CHECK(arrays[a].elements.size() <= 4);
    for (const auto& element : arrays[a].elements) {
      CHECK_FALSE(element.empty());
      CHECK((element.size() == 1 || static_cast<double>(element.size()) * arrays[a].run.wall_s <= 21));
      for (const std::size_t t : element) {
        CHECK(seen.insert(t).second);
        CHECK(agenda.tasks[t].run.wall_s == arrays[a].run.wall_s);
        array_of[agenda.tasks[t].planned.key] = a;
      }
    }
  }
  CHECK(seen.size() == tasks.size());
  for (const Task& task : agenda.tasks) {
    if (task.planned.job.parent.empty())
      continue;
    const std::size_t own = array_of.at(task.planned.key);
    const std::size_t parents = array_of.at(task.planned.job.parent);
    CHECK(parents < own);
    CHECK(std::count(arrays[own].after.begin(), arrays[own].after.end(), parents) == 1);
  }
}

TEST_CASE("a parent that is recorded already is not waited for") {
  const Agenda agenda = agenda_of({{7, -1}, {7, 0}});
  const std::vector<std::size_t> child{1};
  const auto arrays = arrange(agenda, child, {}, 100);
  REQUIRE(arrays.size() == 1);
  CHECK(arrays[0].after.empty());
}

TEST_CASE("sbatch is told time and memory with room, bounds, dependencies and what the profile says") {
  const Agenda agenda = agenda_of(std::vector<std::pair<double, int>>(12, {100, -1}));
  ClusterProfile profile;
  profile.max_running = 3;
  profile.partition = "long";
  profile.bundle_wall_s = 250;
  auto arrays = arrange(agenda, all_of(agenda), profile, 100);
  REQUIRE(arrays.size() == 1);
  arrays[0].run.timing = TimingMode::exclusive;
  const auto arguments = sbatch_arguments(
      {.name = "tamp-a-0", .array = arrays[0], .after = {"17", "19"}, .script = "/s/array.sh", .logs = "/s/logs"},
      profile);
  const auto has = [&](const std::string& argument) {
    return std::find(arguments.begin(), arguments.end(), argument) != arguments.end();
  };
  CHECK(has("--parsable"));
  CHECK(has("--array=0-5%3"));
  CHECK(has("--time=5"));    // two jobs of 100 s and 10 s each, and a minute: 280 s
  CHECK(has("--mem=4097M")); // 4296 MB
  CHECK(has("--partition=long"));
  CHECK(has("--exclusive"));
  CHECK(has("--dependency=afterany:17:19"));
  CHECK(arguments.back() == "/s/array.sh");
  CHECK(std::none_of(arguments.begin(), arguments.end(),
                     [](const std::string& argument) { return argument.starts_with("--account"); }));
}
