// Which jobs a campaign makes, in which order, with which labels and points.
#include "campaigns/campaign.h"
#include "tests/campaigns/campaign_text.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tamp::test {

namespace {

const std::string kBase = R"({"campaign": "c",
  "scene": {"size": 100, "psd": {"law": "monodisperse", "radius": 1}}, "methods": METHODS, "sweep": SWEEP, "replicates": 2})";

Plan plan_of(const std::string& sweep, const std::string& methods = R"(["drop-and-roll"])") {
  return read_campaign(with(with(kBase, "SWEEP", sweep), "METHODS", methods), "c.json");
}

/// One line a job: label, replicate, point.
std::vector<std::string> lines(const Plan& plan) {
  std::vector<std::string> out;
  for (const PlannedJob& job : plan.jobs) {
    std::string line = fmt::format("{} {}", job.label, job.job.replicate);
    for (const auto& [path, value] : job.point)
      line += fmt::format(" {}={}", path.substr(path.rfind('/') + 1), value);
    out.push_back(line);
  }
  return out;
}

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("a grid multiplies, the first path slowest and replicates innermost") {
  const Plan plan = plan_of(R"({"grid": {"scene/size": [40, 20], "scene/psd/radius": [1, 2]}})");
  CHECK(lines(plan) == Lines{"drop-and-roll 0 radius=1 size=40", "drop-and-roll 1 radius=1 size=40",
                             "drop-and-roll 0 radius=2 size=40", "drop-and-roll 1 radius=2 size=40",
                             "drop-and-roll 0 radius=1 size=20", "drop-and-roll 1 radius=1 size=20",
                             "drop-and-roll 0 radius=2 size=20", "drop-and-roll 1 radius=2 size=20"});
  CHECK(plan.jobs[2].job.scene.size == std::vector<double>{40, 40, 40}); // completed
  CHECK(plan.jobs[2].job.scene.psd.radius == 2);
  std::set<std::string> keys;
  for (const PlannedJob& job : plan.jobs) {
    CHECK(job.key == job_key(job.job));
    keys.insert(job.key);
  }
  CHECK(keys.size() == 8);
}

TEST_CASE("a zip walks its lists together, also over replicates and seeds") {
  const Plan plan = plan_of(R"({"zip": {"scene/size": [20, [30, 40, 50]], "replicates": [1, 2], "seed": [7, 8]}})");
  CHECK(lines(plan) == Lines{"drop-and-roll 0 size=20 seed=7", "drop-and-roll 0 size=[30,40,50] seed=8",
                             "drop-and-roll 1 size=[30,40,50] seed=8"});
  CHECK(plan.jobs[0].job.seed == 7);
}

TEST_CASE("grid, zip and points of one block multiply in their order; blocks are joined") {
  CHECK(
      plan_of(R"({"zip": {"scene/size": [20, 30], "scene/count": [5, 6]}, "grid": {"seed": [1, 2, 3]}})").jobs.size() ==
      2 * 3 * 2);
  const Plan plan = plan_of(R"([{"grid": {"scene/size": [20]}, "points": [{"seed": 1}, {"seed": 2, "replicates": 1}]},
                                {"points": [{"scene/size": 50, "replicates": 1}]}])");
  CHECK(lines(plan) == Lines{"drop-and-roll 0 size=20 seed=1", "drop-and-roll 1 size=20 seed=1",
                             "drop-and-roll 0 size=20 seed=2", "drop-and-roll 0 size=50"});
}

TEST_CASE("equal jobs stay once, the first of them") {
  const Plan plan =
      plan_of(R"([{"grid": {"scene/size": [20, 20]}}, {"points": [{"scene/size": [20, 20, 20], "replicates": 3}]}])");
  CHECK(lines(plan) == Lines{"drop-and-roll 0 size=20", "drop-and-roll 1 size=20", "drop-and-roll 2 size=[20,20,20]"});
}

TEST_CASE("a swept method parameter makes copies only of methods that have it") {
  const Plan plan = plan_of(R"({"grid": {"method/max_failures": [50, 200]}})",
                            R"([{"name": "drop-and-roll", "label": "D&R"}, {"name": "lattice", "kind": "fcc"}])");
  CHECK(lines(plan) == Lines{"D&R 0 max_failures=50", "D&R 1 max_failures=50", "lattice 0", "lattice 1",
                             "D&R 0 max_failures=200", "D&R 1 max_failures=200"});
  CHECK(plan.jobs[4].job.method.drop_and_roll.max_failures == 200);
  CHECK(plan.jobs[2].job.method.lattice.kind == LatticeKind::fcc);
}

TEST_CASE("a law can be swept with the parameters of each") {
  const Plan plan = plan_of(R"({"points": [{"scene/psd/radius": 2},
    {"scene/psd/law": "bimodal", "scene/psd/small_radius": 1, "scene/psd/size_ratio": 3, "scene/psd/large_volume_fraction": 0.7}]})");
  REQUIRE(plan.jobs.size() == 4);
  CHECK(plan.jobs[0].job.scene.psd.radius == 2);
  CHECK(plan.jobs[2].job.scene.psd.law == Law::bimodal);
  const auto composition = [](const Plan& made) {
    return std::any_of(made.metrics.begin(), made.metrics.end(),
                       [](const Metric& metric) { return metric.name == MetricName::composition; });
  };
  CHECK_FALSE(composition(plan)); // it says nothing about equal spheres
  CHECK(composition(read_campaign(R"({"campaign": "c", "methods": ["drop-and-roll"], "scene": {"size": 20,
    "psd": {"law": "bimodal", "small_radius": 1, "size_ratio": 3, "large_volume_fraction": 0.7}}})",
                                  "c.json")));
  CHECK_FALSE(stated(plan.jobs[2].job.scene.psd.radius)); // the base scene's radius counts only for its law
}

TEST_CASE("a powder stated by moments is the powder stated by parameters") {
  const auto key = [](std::string_view powder) {
    const std::string text = R"({"campaign": "c", "methods": ["drop-and-roll"],
      "scene": {"size": 133, "psd": {"law": "lognormal", "r_min": 0.1, "r_max": 50, POWDER}}})";
    return read_campaign(with(text, "POWDER", powder), "c.json").jobs.at(0).key;
  };
  const std::string parameters = key(R"("mu_ln": 0.30, "sigma_ln": 0.68)");
  CHECK(parameters == key(R"("sigma_ln": 0.68, "mean": 1.70, "mu_ln": 0.30, "sd": 1.30)"));
  CHECK(parameters != key(R"("mean": 1.70, "sd": 1.30)")); // rounded moments are another, near powder
}

TEST_CASE("what is not stated takes its default") {
  const Plan plan = read_campaign(kValid, "some/folder/c.json");
  CHECK(plan.campaign == "test");
  CHECK(plan.title == "test");
  CHECK(plan.file == "some/folder/c.json");
  const Psd& psd = plan.jobs.at(0).job.scene.psd;
  CHECK(plan.metrics.size() ==
        static_cast<std::size_t>(
            std::count_if(metrics().begin(), metrics().end(), [&](const MetricInfo& m) { return m.applies(psd); })));
  CHECK(plan.run.wall_s == 3600);
  CHECK(plan.run.timing == TimingMode::shared);
  CHECK(plan.report.tables.empty());
  CHECK(plan.jobs.at(0).job.seed == 1);
  CHECK(plan.jobs.at(0).label == "drop-and-roll");
}

TEST_CASE("settings of the run, the metrics and the report are read") {
  const Plan plan = read_campaign(valid_with("\"replicates\": 2", R"("title": "T", "seed": 5, "timing": "exclusive",
    "budget": {"wall_s": 12.5, "memory_mb": 1e3}, "report": {"tables": ["lognormal_3d", "lognormal_2d"]},
    "metrics": ["phi", {"name": "hellinger", "bins": 40}])"),
                                  "c.json");
  CHECK(plan.title == "T");
  CHECK(plan.jobs.size() == 2); // one replicate of each point
  CHECK(plan.jobs.at(0).job.seed == 5);
  CHECK(plan.run.wall_s == 12.5);
  CHECK(plan.run.memory_mb == 1000);
  CHECK(plan.run.timing == TimingMode::exclusive);
  CHECK(plan.report.tables == Lines{"lognormal_3d", "lognormal_2d"});
  REQUIRE(plan.metrics.size() == 2);
  CHECK(plan.metrics[0].name == MetricName::phi);
  CHECK(plan.metrics[1].bins == 40);
}

TEST_CASE("the same text makes the same plan") {
  const Plan a = read_campaign(kValid, "c.json");
  const Plan b = read_campaign(kValid, "c.json");
  CHECK(lines(a) == lines(b));
  for (std::size_t i = 0; i < a.jobs.size(); ++i)
    CHECK(a.jobs[i].key == b.jobs.at(i).key);
}

} // namespace tamp::test
