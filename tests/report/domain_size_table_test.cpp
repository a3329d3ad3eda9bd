// The table of boxes of many sizes: families, times of one mode, the fit, the representative volume.
#include "report/domain_size_table.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tamp;
using namespace tamp::test;

namespace {

Scene box(double edge, double r_max = 50) {
  Scene scene = paper_scene(3);
  scene.size = {edge, edge, edge};
  scene.psd.r_max = r_max;
  return scene;
}

struct Sizes : SyntheticCampaign {
  Sizes() { plan.report.tables = {"domain_size"}; }
  /// Two packings with the mean density `phi`, N = edge^3/100 and t = 1e-5 N^1.2.
  void add(const Scene& scene, double phi, double half_difference, const std::string& label = "D&R") {
    const double count = std::pow(scene.size[0], 3) / 100;
    for (const int replicate : {0, 1}) {
      const std::string key = add_ok(scene, replicate, phi + (replicate == 0 ? 1 : -1) * half_difference,
                                     1e-5 * std::pow(count, 1.2), label);
      records[key].measures = {{"N", count, "1"}};
    }
  }
  [[nodiscard]] std::vector<SizeFamily> families() const {
    const auto joined = runs();
    return size_families(joined);
  }
  [[nodiscard]] Table table() const { return domain_size_table(families()); }
};

const Cell& cell_of(const Panel& panel, std::string_view heading, std::string_view quantity) {
  for (const Group& group : panel.groups) {
    for (std::size_t i = 0; i < panel.columns.size(); ++i) {
      if (group.heading == heading && panel.columns[i].quantity == quantity)
        return group.lines.at(0).cells.at(i);
    }
  }
  FAIL("no cell " << heading << ", " << quantity);
  return panel.groups.at(0).lines.at(0).cells.at(0);
}

bool mentions(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

} // namespace

TEST_CASE("Boxes of all sizes of one powder and method are one family, whatever the order and the cut") {
  Sizes campaign;
  campaign.add(box(133), 0.64, 0.001);
  campaign.add(box(30, 15), 0.60, 0.001);
  campaign.add(box(80, 40), 0.63, 0.001);
  campaign.add(box(80), 0.63, 0.001, "other");
  Scene wide = box(80);
  wide.psd.sigma_ln = 0.5;
  campaign.add(wide, 0.63, 0.001, "other");
  const auto families = campaign.families();
  REQUIRE(families.size() == 3);
  REQUIRE(families[0].groups.size() == 3);
  CHECK(edge_of(families[0].groups[0]) == 30);
  CHECK(edge_of(families[0].groups[2]) == 133);
  CHECK(families[0].name == "D&R");
  CHECK(families[1].name == "other, lognormal");
}

TEST_CASE("The edge of a box that is no cube is that of the cube as large, in any unit") {
  RunGroup group;
  group.runs.emplace_back();
  group.runs[0].planned.job.scene = box(1);
  group.runs[0].planned.job.scene.size = {10, 20, 40};
  CHECK(edge_of(group) == Approx(20));
  group.runs[0].planned.job.scene.unit = LengthUnit::mm;
  CHECK(edge_of(group) == Approx(20000));
}

TEST_CASE("Fit and representative volume of invented packings") {
  Sizes campaign;
  campaign.add(box(30, 15), 0.55, 0.020);
  campaign.add(box(80, 40), 0.62, 0.003);
  campaign.add(box(110), 0.635, 0.002);
  campaign.add(box(133), 0.641, 0.002);
  campaign.add(box(210), 0.640, 0.001);
  const Table table = campaign.table();
  REQUIRE(table.panels.size() == 4);
  CHECK(cell_of(table.panels[0], "D&R, ⟨X⟩ = 133 µm", "phi_paper").value == Approx(0.641));
  CHECK(cell_of(table.panels[0], "D&R, ⟨X⟩ = 133 µm", "t_over_fit").value == Approx(1));
  CHECK(cell_of(table.panels[2], "D&R", "beta").value == Approx(1.2));
  CHECK(cell_of(table.panels[2], "D&R", "points").value == 5);
  CHECK(cell_of(table.panels[3], "D&R: ⟨phi_paper⟩", "plateau").value == Approx(0.640));
  CHECK(cell_of(table.panels[3], "D&R: ⟨phi_paper⟩", "X_RVE").value == 110);
  CHECK(cell_of(table.panels[3], "D&R: ⟨H_N⟩ − ⟨H_N_floor⟩", "X_RVE").value == 30);
  CHECK(mentions(campaign.report().at("domain_size.csv"), ",D&R: phi_paper,this run,X_RVE,um,110,,"));
}

TEST_CASE("A distance that falls with its floor does not converge: its excess does") {
  Sizes campaign;
  const auto metric = [&](const PlannedJob& planned, double h, double floor) {
    campaign.add_metric(planned.key, 0, {{"H_N", h}, {"H_N_floor", floor}});
  };
  for (const double edge : {60.0, 110.0, 210.0})
    campaign.add(box(edge), 0.64, 0.001);
  for (const PlannedJob& planned : campaign.plan.jobs) {
    const double floor = 10 / planned.job.scene.size[0];
    metric(planned, floor + 0.001, floor); // 0.17 to 0.05: more than the tolerance apart
  }
  const Table table = campaign.table();
  CHECK(cell_of(table.panels[3], "D&R: ⟨H_N⟩ − ⟨H_N_floor⟩", "X_RVE").value == 60);
  CHECK(cell_of(table.panels[3], "D&R: ⟨H_N⟩ − ⟨H_N_floor⟩", "plateau").value == Approx(0.001));

  for (const PlannedJob& planned : campaign.plan.jobs)
    metric(planned, 0.05, 10 / planned.job.scene.size[0]); // the same H in all boxes is ever further from its floor
  CHECK(cell_of(campaign.table().panels[3], "D&R: ⟨H_N⟩ − ⟨H_N_floor⟩", "X_RVE").word == "none");
}

TEST_CASE("Exclusive and shared times are never in one fit") {
  Sizes campaign;
  for (const double edge : {60.0, 80.0, 110.0, 150.0, 210.0})
    campaign.add(box(edge), 0.64, 0.001);
  for (const PlannedJob& planned : campaign.plan.jobs) {
    Record& record = campaign.records[planned.key];
    if (planned.job.scene.size[0] == 210 || planned.job.replicate == 1) {
      record.timing.mode = TimingMode::shared;
      record.timing.wall_s *= 100;
    }
  }
  const auto families = campaign.families();
  const TimedPoints timed = timed_points(families.at(0));
  CHECK(timed.mode == TimingMode::exclusive);
  CHECK(timed.points.size() == 4);
  CHECK(timed.left_out == 6);
  CHECK_FALSE(timed.of_group.at(4));
  CHECK(cell_of(campaign.table().panels[2], "D&R", "beta").value == Approx(1.2));
  CHECK(cell_of(campaign.table().panels[0], "D&R, ⟨X⟩ = 210 µm", "t_over_fit").empty());
  CHECK(mentions(campaign.report().at("report.md"), "6 runs in the other timing mode are left out of the fit"));
}

TEST_CASE("Disturbed times are in no fit, and times of different processors in none without a word") {
  Sizes campaign;
  for (const double edge : {60.0, 80.0, 110.0, 150.0, 210.0})
    campaign.add(box(edge), 0.64, 0.001);
  CHECK_FALSE(mentions(campaign.report().at("report.md"), "different processors"));
  for (const PlannedJob& planned : campaign.plan.jobs) {
    Record& record = campaign.records[planned.key];
    if (planned.job.replicate == 1) {
      record.timing.conditions.disturbed = "off its core";
      record.timing.wall_s *= 100;
    } else if (planned.job.scene.size[0] == 210) {
      record.provenance.cpu_model = "Another CPU";
    }
  }
  const auto families = campaign.families();
  const TimedPoints timed = timed_points(families.at(0));
  CHECK(timed.points.size() == 5);
  CHECK(timed.disturbed == 5);
  CHECK(timed.left_out == 0);
  CHECK(timed.processors.size() == 2);
  CHECK(cell_of(campaign.table().panels[2], "D&R", "beta").value == Approx(1.2));
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "5 disturbed times are left out of the fit"));
  CHECK(mentions(page, "the fit joins times of different processors, Another CPU and "));
}

TEST_CASE("Too few points are said to be, and packings of stated counts have no convergence") {
  Sizes campaign;
  for (const double edge : {60.0, 80.0}) {
    Scene scene = box(edge);
    scene.count = 1000;
    campaign.add(scene, 0.64, 0.001);
  }
  const Table table = campaign.table();
  CHECK(table.panels.size() == 3);
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "too few points (2; at least 4)"));
  CHECK(mentions(page, "narrow range"));
}

TEST_CASE("A size whose runs all ended otherwise says so and is left out of the fit") {
  Sizes campaign;
  for (const double edge : {30.0, 60.0, 110.0, 210.0})
    campaign.add(box(edge, 15), 0.64, 0.001);
  for (const PlannedJob& planned : campaign.plan.jobs) {
    if (planned.job.scene.size[0] == 210) {
      campaign.records[planned.key].outcome = Outcome::time_limited;
      campaign.records[planned.key].reason = "more than 10 s";
    }
  }
  const Table table = campaign.table();
  CHECK(cell_of(table.panels[0], "D&R, ⟨X⟩ = 210 µm", "N_part").word == "time-limited");
  CHECK(cell_of(table.panels[2], "D&R", "points").value == 3);
  CHECK(mentions(campaign.report().at("report.md"), "more than 10 s"));
}

TEST_CASE("A campaign that has not run has no panel") {
  Sizes campaign;
  campaign.plan_job(box(30, 15), 0);
  CHECK(campaign.table().panels.empty());
  CHECK(mentions(campaign.report().at("report.md"), "No record of 1 generation job"));
}
