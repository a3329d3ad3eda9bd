// Jobs survive their way through a file, to the last bit.
#include "campaigns/job_file.h"
#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/model/parameter.h"
#include "tests/campaigns/campaign_text.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

namespace tamp::test {

namespace {

/// A value that a row allows, over the whole of its range.
template <class Root>
JsonLeaf random_leaf(const Parameter<Root>& row, RandomStream& random) {
  const auto number = [&] {
    for (;;) {
      const double x = (random.below(2) == 0 ? 1 : -1) * std::exp(80 * (random.uniform() - 0.5));
      if (row.range.holds(x))
        return x;
    }
  };
  switch (row.kind) {
  case ParameterKind::boolean:
    return random.below(2) == 0;
  case ParameterKind::integer: {
    const auto low = static_cast<std::int64_t>(row.range.low);
    return low +
           static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(row.range.high - row.range.low) + 1));
  }
  case ParameterKind::number:
    return number();
  case ParameterKind::choice:
    return std::string(row.choices[random.below(row.choices.size())]);
  case ParameterKind::numbers: {
    std::vector<double> out(1 + random.below(5));
    for (double& x : out)
      x = number();
    return out;
  }
  }
  return false;
}

template <class Root>
void randomise(std::span<const Parameter<Root>> table, Root& root, RandomStream& random) {
  for (const auto& row : table) {
    if (row.applies(root))
      row.set(root, random_leaf(row, random));
  }
}

} // namespace

TEST_CASE("random jobs read back with the same key and the same values") {
  RandomStream random("jobs", 0);
  for (int i = 0; i < 2000; ++i) {
    Job job;
    randomise(scene_parameters(), job.scene, random);
    randomise(method_parameters(), job.method, random);
    job.seed = static_cast<std::int64_t>(random.bits() >> 1U);
    job.replicate = static_cast<std::int64_t>(random.below(1000));
    job.parent = random.below(2) == 0 ? "" : job_key(Job{});
    const std::string text = job_json(job);
    INFO(text);
    const Job back = read_job(text);
    REQUIRE(job_key(back) == job_key(job));
    REQUIRE(back.seed == job.seed);
    REQUIRE(back.scene.size == job.scene.size); // doubles exact
    REQUIRE(back.parent == job.parent);
    REQUIRE(job_json(back) == text);
  }
}

TEST_CASE("every job of a plan reads back, also with a line break at the end") {
  for (const PlannedJob& planned : read_campaign(kValid, "c.json").jobs)
    CHECK(job_key(read_job(job_json(planned.job) + "\n")) == planned.key);
}

TEST_CASE("texts that are no job of this program are refused") {
  const std::string text = job_json(read_campaign(kValid, "c.json").jobs.at(0).job);
  CHECK_NOTHROW(read_job(text));
  const auto revision = info(MethodName::drop_and_roll).revision;
  CHECK_THROWS_WITH(
      read_job(with(text, fmt::format("\"revision\":{}", revision), "\"revision\":99")),
      fmt::format("job file: made for revision 99 of drop-and-roll, this program has revision {}", revision));
  CHECK_THROWS_AS(read_job(with(text, "generation", "metric")), InputError);
  CHECK_THROWS_AS(read_job(with(text, "\"seed\":1", "\"seed\":\"1\"")), InputError);
  CHECK_THROWS_AS(read_job(with(text, "\"mu_ln\":0.3", "\"mu_ln\":0.3,\"skew\":1")), InputError);
  CHECK_THROWS_AS(read_job(with(text, "\"lognormal\"", "\"lognormale\"")), InputError);
  CHECK_THROWS_AS(read_job("{}"), InputError);
  CHECK_THROWS_AS(read_job(""), InputError);
  for (std::size_t i = 0; i < text.size(); ++i)
    CHECK_THROWS_AS(read_job(text.substr(0, i)), InputError);
}

} // namespace tamp::test
