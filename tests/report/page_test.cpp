// The page and the decision table: who wins, what is escaped, which runs stand behind a number.
#include "report/decision_table.h"
#include "report/html.h"
#include "report/page.h"
#include "report/t_test.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <array>
#include <regex>

using namespace tamp;
using namespace tamp::test;

namespace {

/// Two methods on one scene: A fast and loose, B slow and dense, each twice.
SyntheticCampaign two_methods() {
  SyntheticCampaign campaign;
  for (int i = 0; i < 2; ++i) {
    campaign.add_ok(paper_scene(3), i, 0.60 + 0.001 * i, 1.0 + 0.01 * i, "A");
    Job job;
    job.scene = paper_scene(3);
    job.seed = 7; // other keys for the other label
    PlannedJob planned{job, "", "B", {}};
    planned.job.replicate = i;
    planned.key = job_key(planned.job);
    campaign.plan.jobs.push_back(planned);
    Record& record = campaign.add_record(planned.key, JobKind::generation, "drop-and-roll");
    record.measures = {{"N", 20000, "1"}};
    record.timing = {TimingMode::exclusive, 9.0 + i, 9, 9, 9, 1};
    campaign.add_metric(planned.key, 0, {{"H_N", 0.02}, {"H_N_floor", 0.0201}, {"H_V", 0.15}, {"H_V_floor", 0.16}});
    campaign.add_metric(planned.key, 1, {{"phi", 0.70 + 0.001 * i}});
  }
  return campaign;
}

const Group::Line& need(const Table& table, std::string_view name) {
  for (const Group& group : table.panels.at(0).groups) {
    if (group.heading.starts_with(name))
      return group.lines.at(0);
  }
  throw std::runtime_error("no such need");
}

} // namespace

TEST_CASE("The decision table names the best and the next, and whether they can be told apart") {
  const SyntheticCampaign campaign = two_methods();
  const auto runs = campaign.runs();
  const Table table = decision_table(runs);
  REQUIRE(table.panels.size() == 1);
  CHECK(need(table, "fastest").cells.at(0).word == "A");
  CHECK(need(table, "densest").cells.at(0).word == "B");
  CHECK(need(table, "densest").cells.at(1).value == Approx(0.7005));
  CHECK(need(table, "densest").cells.at(3).value == Approx(0.6105));
  CHECK(need(table, "densest").cells.at(4).word == "yes (p = 6.2e-05)");
  CHECK(need(table, "densest").cells.at(1).keys.size() == 2);
  CHECK(need(table, "most faithful").cells.at(4).word == "no: equal"); // both have the same H
  CHECK(table.panels.at(0).title == "lognormal powder in 3D, box 133 × 133 × 133 µm, walls");
  CHECK(html_table(table).find("<th>Need</th>") != std::string::npos);
}

TEST_CASE("With the packing fraction of an experiment the closest method is named, and the closest per cost") {
  const SyntheticCampaign campaign = two_methods();
  const auto runs = campaign.runs();
  CHECK_THROWS(need(decision_table(runs), "closest to"));
  CHECK(need(decision_table(runs, 0.62), "closest to").cells.at(0).word == "A");
  const Table dense = decision_table(runs, 0.69);
  CHECK(need(dense, "closest to").cells.at(0).word == "B");
  CHECK(need(dense, "closest to").cells.at(3).value == Approx(0.0795));
  const Group::Line per_cost = need(dense, "closest per cost");
  const double cost_a = need(dense, "fastest").cells.at(1).value;
  const double cost_b = need(dense, "fastest").cells.at(3).value;
  CHECK(per_cost.cells.at(0).word == (0.0795 * cost_a < 0.0105 * cost_b ? "A" : "B"));
}

TEST_CASE("Methods are told apart by the test of tamp compare, for as many as they are chosen among") {
  // n = 2: the means are 3.2 standard errors apart, which with two replicates happens every fifth time.
  SyntheticCampaign campaign;
  for (int i = 0; i < 2; ++i) {
    campaign.add_ok(paper_scene(3), i, 0.60 + 0.010 * i, 1, "A", method_named(MethodName::drop_and_roll));
    campaign.add_ok(paper_scene(3), i, 0.62 + 0.005 * i, 1, "B", method_named(MethodName::dem_gravity));
  }
  const std::vector<double> a = {0.61, 0.62};
  const std::vector<double> b = {0.63, 0.635};
  const auto two = campaign.runs();
  CHECK(need(decision_table(two), "densest").cells.at(4).word == fmt::format("no (p = {:.2g})", welch_test(a, b)->p));

  for (int i = 0; i < 2; ++i)
    campaign.add_ok(paper_scene(3), i, 0.50 + 0.001 * i, 1, "C", method_named(MethodName::lammps_gravity));
  const auto three = campaign.runs();
  const double p = welch_test(a, b)->p;
  CHECK(need(decision_table(three), "densest").cells.at(4).word == fmt::format("no (p = {:.2g})", p)); // the larger one

  // Pairs: what is made from the other's packing.
  SyntheticCampaign paired;
  const std::array rise = {0.011, 0.012, 0.010};
  for (std::size_t i = 0; i < 3; ++i) {
    const double phi = 0.60 + 0.01 * static_cast<double>(i);
    const auto replicate = static_cast<std::int64_t>(i);
    const std::string bed = paired.add_ok(paper_scene(3), replicate, phi, 1, "bed");
    paired.add_ok(paper_scene(3), replicate, phi + rise[i], 1, "ME", method_named(MethodName::drop_and_roll_me), bed);
  }
  const auto joined = paired.runs();
  CHECK(need(decision_table(joined), "densest").cells.at(4).word == "yes (p = 0.0027)");
}

TEST_CASE("The most faithful keeps the law by number and by volume, and is not chosen among equal draws") {
  SyntheticCampaign campaign;
  const auto add = [&](const std::string& label, MethodName name, double h_n, double h_v, int replicate) {
    const std::string key = campaign.add_ok(paper_scene(3), replicate, 0.6, 1, label, method_named(name));
    campaign.add_metric(key, 0, {{"H_N", h_n}, {"H_N_floor", 0.01}, {"H_V", h_v}, {"H_V_floor", 0.2}});
  };
  for (int i = 0; i < 2; ++i) {
    add("fines", MethodName::drop_and_roll, 0.22 + 0.001 * i, 0.18, i); // 22 floors by number, none by volume
    add("gravity", MethodName::dem_gravity, 0.010 + 0.001 * i, 0.21, i);
    add("isostatic", MethodName::dem_isostatic, 0.011 + 0.001 * i, 0.22, i);
  }
  const auto runs = campaign.runs();
  const Table table = decision_table(runs);
  const Group::Line& faithful = need(table, "most faithful");
  CHECK(faithful.cells.at(0).word == "gravity, isostatic");
  CHECK(faithful.cells.at(1).value == Approx(0.015));
  CHECK(faithful.cells.at(2).word == "fines");
  CHECK(faithful.cells.at(3).value == Approx(0.2105));
  CHECK(need(table, "of these: excess by number").cells.at(1).value == Approx(0.001));
  CHECK(need(table, "of these: excess by volume").cells.at(3).value == Approx(-0.02));

  SyntheticCampaign none;
  for (const char* label : {"x", "y"}) {
    Method method;
    method.drop_and_roll.max_failures = *label; // another key
    const std::string key = none.add_ok(paper_scene(3), 0, 0.6, 1, label, method);
    none.add_metric(key, 0, {{"H_N", *label == 'x' ? 0.2 : 0.3}, {"H_N_floor", 0.01}});
  }
  const auto far = none.runs();
  CHECK(need(decision_table(far), "most faithful").cells.at(0).word == "none within 2 floors; nearest: x");
}

TEST_CASE("Density is judged among packings of the scene's mixture, of periodic ones over the whole box") {
  SyntheticCampaign campaign;
  campaign.plan.metrics.push_back({MetricName::composition});
  Scene scene = paper_scene(3);
  scene.psd = {};
  scene.psd.law = Law::bimodal;
  scene.psd.small_radius = 1;
  scene.psd.size_ratio = 10;
  scene.psd.large_volume_fraction = 0.75;
  scene = completed(scene);
  const auto add = [&](const std::string& label, MethodName name, double phi, double share) {
    const std::string key = campaign.add_ok(scene, 0, phi, 1, label, method_named(name));
    campaign.add_metric(key, 6, {{"X_L", share}});
    return key;
  };
  add("D&R", MethodName::drop_and_roll, 0.9, 0.6);
  add("gravity", MethodName::dem_gravity, 0.7, 0.74);
  const std::string pressed = add("isostatic", MethodName::dem_isostatic, 0.6, 0.75);
  campaign.records[pressed].measures.push_back({"phi_box", 0.8, "1"});
  const std::string failed = add("lammps", MethodName::lammps_gravity, 0.7, 0.75);
  campaign.records[failed].outcome = Outcome::time_limited;
  const auto runs = campaign.runs();
  const Table table = decision_table(runs);
  CHECK(need(table, "densest").cells.at(0).word == "isostatic");
  CHECK(need(table, "densest").cells.at(1).value == 0.8);
  CHECK(need(table, "densest").cells.at(2).word == "gravity");
  CHECK(table.panels.at(0).title == "bimodal powder in 3D, ⟨rho⟩ = 10, ⟨X_L⟩ = 0.75, box 133 × 133 × 133 µm, walls; "
                                    "periodic on all sides: isostatic");
  REQUIRE(table.notes.size() == 2);
  CHECK(table.notes[1].text.find("Without a packing, so not judged: lammps (time-limited).") != std::string::npos);
  CHECK(table.notes[1].text.find("not judged by density: D&R (⟨X_L⟩ = 0.600).") != std::string::npos);
}

TEST_CASE("Times taken beside other jobs decide nothing, and one method alone is no choice") {
  SyntheticCampaign campaign = two_methods();
  for (auto& [key, record] : campaign.records)
    record.timing.mode = TimingMode::shared;
  CHECK_THROWS(need(decision_table(campaign.runs()), "fastest"));
  SyntheticCampaign alone;
  alone.add_ok(paper_scene(3), 0, 0.6, 1);
  CHECK(decision_table(alone.runs()).panels.empty());
}

TEST_CASE("Every key that a cell names is among the page's runs, with seed, commit and job") {
  const SyntheticCampaign campaign = two_methods();
  const std::string page = campaign.report().at("index.html");
  const std::regex cell("data-k=\"([^\"]+)\"");
  std::size_t cells = 0;
  for (auto match = std::sregex_iterator(page.begin(), page.end(), cell); match != std::sregex_iterator(); ++match) {
    const std::string keys = (*match)[1];
    for (std::size_t at = 0; at < keys.size(); at += 65) // 64 digits and a blank
      CHECK(page.find('"' + keys.substr(at, 64) + "\":{\"method\":") != std::string::npos);
    ++cells;
  }
  CHECK(cells > 10);
  CHECK(page.find("\"seed\":7,\"replicate\":1") != std::string::npos);
  CHECK(page.find("\"commit\":\"0123456789abcdef") != std::string::npos);
  CHECK(page.find("<script src") == std::string::npos);
  CHECK(page.find("http") == std::string::npos); // no network
}

TEST_CASE("Nothing of a campaign can become a mark or a script of the page") {
  SyntheticCampaign campaign;
  campaign.plan.title = "<b>a</b> & \"b\"";
  campaign.add_ok(paper_scene(2), 0, 0.8, 1, "</script><script>alert(1)</script>");
  const std::string page = campaign.report().at("index.html");
  CHECK(page.find("<script>alert") == std::string::npos);
  CHECK(page.find("<title>&lt;b&gt;a&lt;/b&gt; &amp; &quot;b&quot;</title>") != std::string::npos);
}

TEST_CASE("What has not run is counted, with the command that runs it") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(2), 0, 0.8, 1);
  campaign.plan_job(paper_scene(2), 1);
  const std::string page = campaign.report().at("index.html");
  CHECK(page.find("2 packings asked for, 1 made, 0 ended otherwise, 1 not yet run") != std::string::npos);
  CHECK(page.find("<code>tamp run campaigns/synthetic.json</code>") != std::string::npos);
}

TEST_CASE("What cannot run for want of its start is counted apart") {
  SyntheticCampaign campaign;
  const std::string bed = campaign.add_ok(paper_scene(2), 0, 0.8, 1);
  campaign.records[bed].outcome = Outcome::time_limited;
  campaign.plan_job(paper_scene(2), 0, "ME", method_named(MethodName::drop_and_roll_me), bed);
  const std::string page = campaign.report().at("index.html");
  CHECK(page.find("2 packings asked for, 0 made, 1 ended otherwise, 0 not yet run. 1 not possible") !=
        std::string::npos);
}
