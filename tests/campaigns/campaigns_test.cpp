// The campaigns that come with tamp ask for what they promise.
#include "campaigns/campaign.h"
#include "engine/base/files.h"
#include "tests/campaigns/campaign_text.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace tamp::test {

namespace {

Plan checked_in(const std::string& name) {
  return load_campaign(std::filesystem::path(TAMP_SOURCE_DIR) / "campaigns" / name);
}

void check_powder(const Job& job) {
  const Psd& psd = job.scene.psd;
  CHECK(psd.law == Law::lognormal);
  CHECK(psd.mu_ln == 0.30);
  CHECK(psd.sigma_ln == 0.68);
  CHECK(psd.r_min == 0.1);
  CHECK(psd.r_max == 50);
  CHECK(job.scene.unit == LengthUnit::um);
  CHECK(job.scene.sides == Sides::walls);
  if (job.method.name != MethodName::drop_and_roll)
    return;
  CHECK(job.method.drop_and_roll.max_failures == 200);
  CHECK(job.method.drop_and_roll.lid);
  CHECK(job.method.drop_and_roll.on_failure == OnFailure::redraw);
}

void check_lognormal(const Plan& plan, const std::vector<double>& size) {
  std::map<std::string, int> rows;
  for (const PlannedJob& planned : plan.jobs) {
    ++rows[planned.label];
    CHECK(planned.job.scene.size == size);
    CHECK(planned.job.scene.dimension == static_cast<std::int64_t>(size.size()));
    check_powder(planned.job);
    if (planned.label == "D&R-ME")
      CHECK(planned.job.parent == plan.jobs.at(static_cast<std::size_t>(planned.job.replicate)).key);
  }
  CHECK(rows.at("D&R") == 5);
  CHECK(rows.at("D&R-ME") == 5);
  CHECK(plan.run.timing == TimingMode::exclusive);
  CHECK(plan.metrics.size() == metrics().size() - 1); // a lognormal powder has no composition
  CHECK(plan.metrics.at(0).bins == 80);
}

} // namespace

TEST_CASE("lognormal-2d and lognormal-3d are the benchmark powder in its boxes") {
  const Plan plane = checked_in("lognormal-2d.json");
  check_lognormal(plane, {600, 600});
  CHECK(plane.report.tables == std::vector<std::string>{"powders", "lognormal_2d"});
  const Plan space = checked_in("lognormal-3d.json");
  check_lognormal(space, {133, 133, 133});
  CHECK(space.report.tables == std::vector<std::string>{"powders", "lognormal_3d"});
}

TEST_CASE("quickstart makes the first packings of both campaigns, under the same keys") {
  const Plan quick = checked_in("quickstart.json");
  CHECK(quick.report.tables == std::vector<std::string>{"powders", "lognormal_2d", "lognormal_3d"});
  REQUIRE(quick.jobs.size() == 8);
  std::set<std::string> keys;
  for (const char* name : {"lognormal-2d.json", "lognormal-3d.json"}) {
    for (const PlannedJob& planned : checked_in(name).jobs)
      keys.insert(planned.key);
  }
  for (const PlannedJob& planned : quick.jobs)
    CHECK(keys.count(planned.key) == 1);
}

TEST_CASE("lattices brings each lattice in its dimension, in boxes from 10 to 80 radii") {
  const Plan plan = checked_in("lattices.json");
  std::map<std::string, std::vector<double>> edges;
  for (const PlannedJob& planned : plan.jobs) {
    const LatticeKind kind = planned.job.method.lattice.kind;
    const bool flat = kind == LatticeKind::square || kind == LatticeKind::hexagonal;
    CHECK(planned.job.scene.dimension == (flat ? 2 : 3));
    CHECK(planned.job.scene.psd.radius == 1);
    edges[std::string(name_of(kind))].push_back(planned.job.scene.size.front());
  }
  CHECK(edges.size() == 6);
  for (const auto& [kind, sizes] : edges) {
    CHECK(sizes.front() == 10);
    CHECK(sizes.back() == 80);
    CHECK(std::is_sorted(sizes.begin(), sizes.end()));
  }
  CHECK(plan.metrics.size() == 4);
}

TEST_CASE("bimodal-3d holds boxes over the size ratio, at least ten large radii long from 10 on") {
  const Plan plan = checked_in("bimodal-3d.json");
  std::set<double> ratios;
  for (const PlannedJob& planned : plan.jobs) {
    const Psd& psd = planned.job.scene.psd;
    ratios.insert(psd.size_ratio);
    CHECK(psd.large_volume_fraction == 0.75);
    CHECK(planned.job.scene.size.front() >= 10 * psd.size_ratio);
  }
  CHECK(ratios == std::set<double>{1, 2, 5, 10, 20, 40});
  CHECK(plan.report.tables == std::vector<std::string>{"powders", "bimodal_3d"});
}

TEST_CASE("furnas covers the plane, and equal spheres once") {
  const Plan plan = checked_in("furnas.json");
  std::set<std::pair<double, double>> places;
  for (const PlannedJob& planned : plan.jobs)
    places.emplace(planned.job.scene.psd.size_ratio, planned.job.scene.psd.large_volume_fraction);
  CHECK(places.size() == 1 + 3 * 11);
  CHECK(plan.report.tables == std::vector<std::string>{"powders", "furnas"});
}

TEST_CASE("domain-size cuts the law where the box is smaller, and shares its 133 um packings with lognormal-3d") {
  const Plan plan = checked_in("domain-size.json");
  std::set<double> sizes;
  std::set<std::string> keys;
  for (const PlannedJob& planned : plan.jobs) {
    const Scene& scene = planned.job.scene;
    sizes.insert(scene.size.front());
    keys.insert(planned.key);
    CHECK(scene.psd.r_max == std::min(50.0, scene.size.front() / 2));
  }
  CHECK(sizes == std::set<double>{30, 80, 110, 133, 150, 210});
  for (const PlannedJob& planned : checked_in("lognormal-3d.json").jobs) {
    if (planned.label == "D&R")
      CHECK(keys.count(planned.key) == 1);
  }
}

TEST_CASE("target-density prescribes densities within 0.002 of the experiment's 0.62") {
  std::set<double> targets;
  for (const PlannedJob& planned : checked_in("target-density.json").jobs) {
    if (const double target = planned.job.method.dem_isostatic.target_phi; target > 0)
      targets.insert(target);
  }
  CHECK(targets == std::set<double>{0.618, 0.62, 0.622});
}

TEST_CASE("scaling states its counts, from a thousand to three million") {
  std::map<Law, std::set<std::int64_t>> counts;
  for (const PlannedJob& planned : checked_in("scaling.json").jobs)
    counts[planned.job.scene.psd.law].insert(planned.job.scene.count);
  CHECK(counts.size() == 3);
  for (const auto& [law, of_law] : counts) {
    CHECK(*of_law.begin() >= 1000);
    CHECK(*of_law.rbegin() == 3000000);
  }
}

TEST_CASE("LAMMPS's campaigns are the powders of the others, in their boxes, and share drop-and-roll's packings") {
  std::set<std::string> keys;
  for (const char* name : {"lognormal-2d.json", "lognormal-3d.json"}) {
    for (const PlannedJob& planned : checked_in(name).jobs)
      keys.insert(planned.key);
  }
  std::map<std::string, int> rows;
  for (const PlannedJob& planned : checked_in("lammps-lognormal.json").jobs) {
    check_powder(planned.job);
    ++rows[planned.label];
    if (planned.label == "D&R")
      CHECK(keys.count(planned.key) == 1);
    CHECK(planned.job.parent.empty() == (planned.label.find("from") == std::string::npos));
    CHECK((planned.job.method.material.friction > 0) == (planned.label.find("Lee2018") != std::string::npos));
  }
  CHECK(rows.size() == 5);
  for (const auto& [label, count] : rows)
    CHECK(count == 4);
  const auto places = [](const char* name) {
    std::set<std::pair<double, double>> found;
    for (const PlannedJob& planned : checked_in(name).jobs)
      found.emplace(planned.job.scene.psd.law == Law::bimodal ? planned.job.scene.psd.size_ratio : 0,
                    planned.job.scene.size.front());
    return found;
  };
  for (const auto& [lammps, other] : {std::pair("lammps-bimodal.json", "bimodal-3d.json"),
                                      std::pair("lammps-domain-size.json", "domain-size.json")}) {
    const auto all = places(other);
    for (const auto& place : places(lammps))
      CHECK(all.count(place) == 1);
  }
  for (const PlannedJob& planned : checked_in("lammps-quick.json").jobs)
    CHECK(planned.job.scene.count == 2000);
}

TEST_CASE("the worked example of the README works, and its mistake is told as the README says") {
  const std::string page = read_file(std::filesystem::path(TAMP_SOURCE_DIR) / "campaigns" / "README.md");
  const std::string fence = "```jsonc\n";
  const std::size_t begin = page.find(fence) + fence.size();
  const std::string example = page.substr(begin, page.find("```", begin) - begin);
  CHECK(read_campaign(example, "patience.json").jobs.size() == 45);
  CHECK_THROWS_WITH(read_campaign(with(example, "\"sigma_ln\":", "\"sigma\":"), "patience.json"),
                    Catch::StartsWith("patience.json:10:7: at /scene/psd/sigma: unknown key \"sigma\"\n"
                                      "  allowed: \"law\", \"radius\", \"mu_ln\", \"sigma_ln\", ") &&
                        Catch::EndsWith("\n  nearest: sigma_ln"));
}

} // namespace tamp::test
