// A job that is timed alone takes as long as with an empty queue when the queue before and behind it is full of others.
#include "report/figures/timeline.h"
#include "report/statistics.h"
#include "report/t_test.h"
#include "store/store.h"
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace tamp::test;
using tamp::Record;

namespace {

constexpr double kAllowed = 0.03; // of the time, as the project promises

/// A campaign of one job that is timed alone, and two of many that are not, and are measured.
class Queue {
public:
  Queue() {
    shop_.write("alone.json", campaign("alone", 900, 1, 1, R"("timing": "exclusive", "metrics": [])"));
    shop_.write("before.json", campaign("before", 150, 16, 2, R"("metrics": ["phi", "coordination"])"));
    shop_.write("behind.json", campaign("behind", 150, 16, 3, R"("metrics": ["phi", "coordination"])"));
  }

  /// Runs these campaigns into a store of their own; every record.
  std::vector<Record> run(const std::string& files) {
    const std::string name = fmt::format("store-{}", ++runs_);
    const Said said = shop_.tamp(fmt::format("run {} --cores 2 --store {}", files, name));
    CAPTURE(said.out, said.err);
    REQUIRE(said.code == 0);
    const auto store = tamp::Store::open(shop_.folder() / name, tamp::Store::Mode::read);
    std::vector<Record> records;
    for (const auto& [key, outcome] : store.outcomes())
      records.push_back(store.find(key).value());
    return records;
  }

private:
  static std::string campaign(const std::string& name, int edge, int replicates, int seed, const std::string& more) {
    return fmt::format(R"({{"campaign": "{}", "scene": {{"dimension": 2, "size": {}, "psd": {{"law": "monodisperse", )"
                       R"("radius": 1}}}}, "methods": ["drop-and-roll"], "replicates": {}, "seed": {}, {}}})",
                       name, edge, replicates, seed, more);
  }

  Workshop shop_{TAMP_BINARY};
  int runs_ = 0;
};

const Record& timed_alone(const std::vector<Record>& records) {
  return *std::find_if(records.begin(), records.end(),
                       [](const Record& r) { return r.timing.mode == tamp::TimingMode::exclusive; });
}

/// Other jobs that ran while the one that is timed alone did.
std::size_t beside(const std::vector<Record>& records) {
  const auto alone = tamp::timeline_bar(timed_alone(records), "").value();
  std::size_t count = 0;
  for (const Record& record : records) {
    const auto other = tamp::timeline_bar(record, "").value();
    const bool is_other = record.key != timed_alone(records).key;
    count += is_other && other.start_s < alone.end_s && alone.start_s < other.end_s ? 1U : 0U;
  }
  return count;
}

/// Times of one side of the comparison.
struct Times {
  std::vector<double> wall_s;
  std::vector<double> cpu_s;
  std::vector<double> undisturbed_s; ///< of wall_s, those that a report counts

  void add(const Record& record) {
    wall_s.push_back(record.timing.wall_s);
    cpu_s.push_back(record.timing.cpu_s);
    if (record.timing.conditions.disturbed.empty())
      undisturbed_s.push_back(record.timing.wall_s);
  }
};

/// Least of the one over least of the other, minus 1: what others do on the machine can only add to a time.
double change(const std::vector<double>& full, const std::vector<double>& empty) {
  return *std::min_element(full.begin(), full.end()) / *std::min_element(empty.begin(), empty.end()) - 1;
}

/// Standard errors by which the queue costs more than is allowed: the mean of ln(full / empty) over the rounds, less
/// ln(1 + kAllowed). Other guests of the machine change single times by a fifth, so a bound on the times themselves
/// would judge them instead of us.
double excess(const std::vector<double>& full, const std::vector<double>& empty) {
  std::vector<double> log_full;
  std::vector<double> log_allowed;
  for (std::size_t i = 0; i < full.size(); ++i) {
    log_full.push_back(std::log(full[i]));
    log_allowed.push_back(std::log(empty[i] * (1 + kAllowed)));
  }
  const auto test = tamp::paired_test(log_allowed, log_full);
  return test ? test->t : 0;
}

struct Compared {
  Times empty;
  Times full;
  /// One time of each side, in turn.
  void round(Queue& queue) {
    empty.add(timed_alone(queue.run("alone.json")));
    const std::vector<Record> records = queue.run("before.json alone.json behind.json");
    REQUIRE(records.size() == 1 + 2 * 16 * 3);
    CHECK(beside(records) == 0);
    full.add(timed_alone(records));
  }
};

} // namespace

TEST_CASE("a job that is timed alone has nothing beside it, and its time does not depend on the queue", "[alone]") {
  Queue queue;
  Compared times;
  constexpr int kFewest = 3;
  constexpr int kMost = 12;
  constexpr double kBeyondDoubt = 2.718; // Student's t of 11 degrees of freedom that chance exceeds once in a hundred
  // A queue can only add: two least times that agree are proof enough, and more rounds are made where they do not.
  bool agree = false;
  for (int round = 0; round < kMost && !agree; ++round) {
    times.round(queue);
    agree = round + 1 >= kFewest && change(times.full.cpu_s, times.empty.cpu_s) < kAllowed;
  }
  CAPTURE(times.empty.cpu_s, times.full.cpu_s);
  CHECK((agree || excess(times.full.cpu_s, times.empty.cpu_s) < kBeyondDoubt));
}

// A measurement for the README: without a bound that could fail, so not among the tests; the one above holds the bound
// in CI.
TEST_CASE("how much the queue changes the time of a job that is timed alone", "[.][bench]") {
  Queue queue;
  Compared times;
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round)
    times.round(queue);
  const auto print = [](const char* what, const std::vector<double>& empty, const std::vector<double>& full) {
    const tamp::Summary a = tamp::summarize(empty);
    const tamp::Summary b = tamp::summarize(full);
    fmt::print("{}: least {:.4f} s and {:.4f} s ({:+.1f} %), median {:.4f} s and {:.4f} s ({:+.1f} %)\n", what,
               a.smallest, b.smallest, 100 * (b.smallest / a.smallest - 1), a.median, b.median,
               100 * (b.median / a.median - 1));
  };
  fmt::print("{} times each with an empty and with a full queue\n", kRounds);
  print("CPU time", times.empty.cpu_s, times.full.cpu_s);
  print("wall-clock time", times.empty.wall_s, times.full.wall_s);
  fmt::print("the {} and {} that were not disturbed:\n", times.empty.undisturbed_s.size(),
             times.full.undisturbed_s.size());
  if (!times.empty.undisturbed_s.empty() && !times.full.undisturbed_s.empty())
    print("wall-clock time", times.empty.undisturbed_s, times.full.undisturbed_s);
}
