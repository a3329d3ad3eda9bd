// Whole reports: statistics, missing and failed jobs, what is compared with the paper, same bytes, files on the disk.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "report/lognormal_table.h"
#include "report/notes.h"
#include "report/report.h"
#include "store/store.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>

using namespace tamp;
using namespace tamp::test;

namespace {

Table table_of(const SyntheticCampaign& campaign, std::string_view name) {
  const auto runs = campaign.runs();
  return lognormal_table(lognormal_groups(runs, paper_table(name)), paper_table(name));
}

const Cell& cell_of(const Table& table, std::size_t panel, std::size_t line, std::string_view quantity) {
  const Panel& grid = table.panels.at(panel);
  for (std::size_t i = 0; i < grid.columns.size(); ++i) {
    if (grid.columns[i].quantity == quantity)
      return grid.groups.at(0).lines.at(line).cells.at(i);
  }
  throw Error("no such column");
}

bool mentions(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

} // namespace

TEST_CASE("A row holds mean, deviation, paper and difference") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(3), 0, 0.631, 1.0);
  campaign.add_ok(paper_scene(3), 1, 0.635, 2.0);
  const Table table = table_of(campaign, "lognormal_3d");
  const Cell& phi = cell_of(table, 0, 0, "phi_paper");
  CHECK(phi.value == Approx(0.633));
  CHECK(phi.spread == Approx(0.004 / std::sqrt(2.0)));
  CHECK(phi.n == 2);
  CHECK(cell_of(table, 0, 1, "phi_paper").value == 0.636);
  CHECK(cell_of(table, 0, 2, "phi_paper").value == Approx(-0.003));
  CHECK(cell_of(table, 0, 2, "N_part").relative == Approx((20005.0 - 19615.0) / 19615.0));
  CHECK(cell_of(table, 0, 2, "time").value == Approx(26 / 1.5));
  CHECK(cell_of(table, 1, 0, "overlap_max").value == 3e-14);
  CHECK(cell_of(table, 1, 0, "K").value == 80);
  CHECK(table_of(campaign, "lognormal_2d").panels.empty());
}

TEST_CASE("A run that is not ok enters no figure and is listed with its reason") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(2), 0, 0.82, 0.2);
  campaign.add_ok(paper_scene(2), 1, 0.82, 0.2);
  const std::string key = campaign.add_ok(paper_scene(2), 2, 0.1, 99);
  campaign.records[key].outcome = Outcome::did_not_converge;
  campaign.records[key].reason = "stopped early";
  const Table table = table_of(campaign, "lognormal_2d");
  CHECK(cell_of(table, 0, 0, "phi_paper").value == Approx(0.82));
  CHECK(cell_of(table, 0, 0, "phi_paper").n == 2);
  CHECK(cell_of(table, 0, 0, "time").value == Approx(0.2));
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "1 job ended did-not-converge"));
  CHECK(mentions(page, "D\\&R replicate 2 (" + short_key(key) + "): stopped early"));
}

TEST_CASE("A method whose runs all ended otherwise keeps its row, with the outcome in it") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(3), 0, 0.63, 1);
  const std::string key = campaign.add_ok(paper_scene(3), 0, 0.7, 99, "DG", method_named(MethodName::dem_gravity));
  campaign.records[key].outcome = Outcome::time_limited;
  campaign.records[key].reason = "not at rest after 12 s";
  const Table table = table_of(campaign, "lognormal_3d");
  REQUIRE(table.panels.at(0).groups.size() == 2);
  const Group& row = table.panels[0].groups[1];
  REQUIRE(row.lines.size() == 2); // this run and the paper
  CHECK(row.lines[0].cells.at(1).word == "time-limited");
  CHECK(row.lines[0].cells.at(4).empty());
  CHECK(row.lines[1].cells.at(1).value == 26726);
  CHECK(table.panels.at(1).groups.size() == 1);
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "| time-limited |"));
  CHECK(mentions(page, "not at rest after 12 s"));
}

TEST_CASE("What cannot run, as its start was not made, is not said to be missing") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(3), 0, 0.63, 1);
  const std::string bed = campaign.add_ok(paper_scene(3), 0, 0.7, 99, "DG", method_named(MethodName::dem_gravity));
  campaign.records[bed].outcome = Outcome::time_limited;
  campaign.plan_job(paper_scene(3), 0, "iso", method_named(MethodName::dem_isostatic), bed);
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "1 job not possible"));
  CHECK(mentions(page, "iso replicate 0"));
  CHECK(mentions(page, "DG (" + short_key(bed) + ") ended time-limited"));
  CHECK(mentions(page, "tamp run campaigns/synthetic.json --retry-limited"));
  CHECK_FALSE(mentions(page, "No record of"));
  CHECK(mentions(page, "| not possible |"));
}

TEST_CASE("Jobs and metrics without a record are listed with the command that runs them") {
  SyntheticCampaign campaign;
  const std::string key = campaign.add_ok(paper_scene(2), 0, 0.82, 0.2);
  campaign.records.erase(campaign.key_of_metric(key, 1));
  campaign.add_metric(key, 5, {{"z", 7}});
  campaign.records[campaign.key_of_metric(key, 5)].outcome = Outcome::failed;
  campaign.records[campaign.key_of_metric(key, 5)].reason = "empty packing";
  const std::string missing = campaign.plan_job(paper_scene(2), 1);
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "No record of 1 generation job and of 1 metric on recorded packings"));
  CHECK(mentions(page, "D\\&R replicate 1 (" + short_key(missing) + ")"));
  CHECK(mentions(page, "phi of D\\&R replicate 0 (" + short_key(campaign.key_of_metric(key, 1)) + ")"));
  CHECK(mentions(page, "tamp run campaigns/synthetic.json"));
  CHECK(mentions(page, "empty packing"));
  CHECK(cell_of(table_of(campaign, "lognormal_2d"), 1, 0, "phi").empty());
  CHECK(cell_of(table_of(campaign, "lognormal_2d"), 1, 0, "z").empty());
}

TEST_CASE("A campaign that has not run gives tables that say so") {
  SyntheticCampaign campaign;
  campaign.plan_job(paper_scene(2), 0);
  const auto files = campaign.report();
  CHECK(mentions(files.at("report.md"), "No record of 1 generation job and of 0 metrics"));
  CHECK(mentions(files.at("report.md"), "The campaign has no lognormal powder in 3D"));
  CHECK(files.at("lognormal_2d.csv") == "table,panel,method,source,quantity,unit,value,sd,n\n");
}

TEST_CASE("Only what may be compared with the paper is compared") {
  const PaperTable& paper = paper_table("lognormal_3d");
  Scene scene = paper_scene(3);
  CHECK(likeness(scene, paper) == Likeness::same);
  Scene metres = scene;
  metres.unit = LengthUnit::m;
  metres.size = {133e-6, 133e-6, 133e-6};
  metres.psd.mu_ln += std::log(1e-6);
  metres.psd.r_min *= 1e-6;
  metres.psd.r_max *= 1e-6;
  CHECK(likeness(metres, paper) == Likeness::same);
  scene.size = {60, 60, 60};
  CHECK(likeness(scene, paper) == Likeness::other_size);
  Scene other = paper_scene(3);
  other.psd.sigma_ln = 0.5;
  CHECK(likeness(other, paper) == Likeness::other_powder);

  SyntheticCampaign small;
  small.add_ok(scene, 0, 0.63, 1);
  const Table table = table_of(small, "lognormal_3d");
  CHECK_FALSE(cell_of(table, 0, 2, "phi_paper").empty());
  CHECK(cell_of(table, 0, 2, "N_part").empty());
  CHECK(cell_of(table, 0, 2, "time").empty());
  CHECK(mentions(small.report().at("report.md"), "the paper's powder in another box"));

  SyntheticCampaign different;
  different.add_ok(other, 0, 0.63, 1);
  CHECK(table_of(different, "lognormal_3d").panels.at(0).groups.at(0).lines.size() == 1);
}

TEST_CASE("A label decides nothing about the comparison with the paper") {
  SyntheticCampaign campaign;
  Method kept;
  kept.drop_and_roll.on_failure = OnFailure::keep;
  campaign.add_ok(paper_scene(3), 0, 0.63, 1, "drop-and-roll");
  campaign.add_ok(paper_scene(3), 0, 0.62, 1, "D&R-ME", kept);
  campaign.add_ok(paper_scene(3), 0, 0.7, 1, "D&R", method_named(MethodName::lammps_isostatic));
  const Panel compared = table_of(campaign, "lognormal_3d").panels.at(0);
  REQUIRE(compared.groups.size() == 3);
  for (const std::size_t group : {0U, 1U}) {
    REQUIRE(compared.groups[group].lines.size() == 3);
    CHECK(compared.groups[group].lines[1].cells[1].value == 19615); // of the paper's D&R
  }
  CHECK(compared.groups[0].remark == "n = 1");
  CHECK(compared.groups[1].remark == "n = 1; not the paper's protocol: on_failure keep");
  CHECK(compared.groups[2].lines.size() == 1);
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "D\\&R: the paper has no such method"));
  CHECK(mentions(page, "D\\&R-ME stands beside the paper's D\\&R, which was made by another protocol"));
}

TEST_CASE("What starts from another row's packing names it, and its factor counts the whole way") {
  SyntheticCampaign campaign;
  const std::string bed = campaign.add_ok(paper_scene(3), 0, 0.63, 200, "my bed");
  const std::string me =
      campaign.add_ok(paper_scene(3), 0, 0.64, 100, "ME", method_named(MethodName::drop_and_roll_me), bed);
  campaign.add_ok(paper_scene(3), 0, 0.7, 50, "iso", method_named(MethodName::dem_isostatic), me);
  const Table table = table_of(campaign, "lognormal_3d");
  const auto factor = [&](std::size_t group) {
    return table.panels.at(0).groups.at(group).lines.at(2).cells.back().value;
  };
  CHECK(factor(0) == Approx(26.0 / 200));
  CHECK(factor(1) == Approx(600.0 / 300));
  CHECK(factor(2) == Approx(92448.0 / 350));
  CHECK(table.panels[0].groups[1].lines[0].cells.back().value == 100); // of the generator alone
  CHECK(table.panels[0].groups[2].remark == "n = 1; from ME, from my bed");
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "started from the packing of the same replicate of my bed"));
  CHECK(mentions(page, "ME starts from packings of my bed: with theirs 5.00 min"));

  campaign.records[bed].timing.mode = TimingMode::shared;
  CHECK(table_of(campaign, "lognormal_3d").panels[0].groups[1].lines[2].cells.back().empty());
}

TEST_CASE("The packing fraction of a whole periodic box stands beside that of the sub-box, and its box is told") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(3), 0, 0.63, 1);
  CHECK_THROWS(cell_of(table_of(campaign, "lognormal_3d"), 1, 0, "phi_box"));
  const std::string key = campaign.add_ok(paper_scene(3), 0, 0.7, 1, "iso", method_named(MethodName::dem_isostatic));
  campaign.records[key].measures.push_back({"phi_box", 0.72, "1"});
  const Table table = table_of(campaign, "lognormal_3d");
  CHECK(table.panels.at(1).columns.at(1).quantity == "phi_box");
  CHECK(table.panels[1].groups.at(0).lines.at(0).cells.at(1).empty());
  CHECK(table.panels[1].groups.at(1).lines.at(0).cells.at(1).value == 0.72);
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "of the whole box, where it is periodic on all sides"));
  CHECK(mentions(page, "iso: name dem-isostatic"));
  CHECK(mentions(page, "pressed in a box of its own that is periodic on all sides"));
}

TEST_CASE("Times of the two modes are never mixed") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(2), 0, 0.82, 0.2);
  const std::string shared = campaign.add_ok(paper_scene(2), 1, 0.82, 5);
  campaign.records[shared].timing.mode = TimingMode::shared;
  CHECK(cell_of(table_of(campaign, "lognormal_2d"), 0, 0, "time").value == 0.2);
  CHECK(cell_of(table_of(campaign, "lognormal_2d"), 0, 0, "time").n == 1);
  CHECK(mentions(campaign.report().at("report.md"), "1 of the 2 replicates"));
}

TEST_CASE("A disturbed time is left out and said to be, and medians have their intervals") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(2), 0, 0.82, 0.2);
  const std::string sampled = campaign.add_ok(paper_scene(2), 1, 0.82, 0.2);
  campaign.records[sampled].timing.samples = {
      {0.2, 0.2, 0, 0, ""}, {0.2, 0.2, 0, 0, ""}, {9, 0.2, 0, 0, "off its core"}};
  const std::string disturbed = campaign.add_ok(paper_scene(2), 2, 0.82, 5);
  campaign.records[disturbed].timing.conditions.disturbed = "off its core";
  CHECK(cell_of(table_of(campaign, "lognormal_2d"), 0, 0, "time").value == 0.2);
  CHECK(cell_of(table_of(campaign, "lognormal_2d"), 0, 0, "time").n == 2);
  const std::string page = campaign.report().at("report.md");
  CHECK(mentions(page, "1 disturbed times left out"));
  CHECK(mentions(page, "the median of several runs in turn (3 in all, 1 of them left out as disturbed)"));
  CHECK(mentions(page, "0.2 to 0.2 s"));
}

TEST_CASE("Groups of one label are told apart by their points") {
  SyntheticCampaign campaign;
  for (const Sampler sampler : {Sampler::random, Sampler::stratified}) {
    Scene scene = paper_scene(2);
    scene.sampler = sampler;
    campaign.add_ok(scene, 0, 0.82, 0.2);
    campaign.plan.jobs.back().point = {{"sampler", std::string(name_of(sampler))}};
  }
  const Table table = table_of(campaign, "lognormal_2d");
  REQUIRE(table.panels.at(0).groups.size() == 2);
  CHECK(table.panels[0].groups[1].heading == "D&R (sampler = stratified)");
  CHECK(table.panels[0].groups[1].lines.size() == 3); // the paper's row is the method's
}

TEST_CASE("The same records give the same bytes") {
  SyntheticCampaign campaign;
  for (int i = 0; i < 3; ++i)
    campaign.add_ok(paper_scene(3), i, 0.63 + 0.001 * i, 1);
  CHECK(campaign.report() == campaign.report());
  const auto before = campaign.report();
  campaign.records.begin()->second.provenance.dirty = true;
  CHECK(campaign.report() != before);
}

TEST_CASE("Unknown tables and none at all are input errors") {
  SyntheticCampaign campaign;
  campaign.plan.report.tables = {"lognormal_4d"};
  CHECK_THROWS_WITH(campaign.report(), Catch::Contains("lognormal_4d") && Catch::Contains("lognormal_2d"));
  campaign.plan.report.tables.clear();
  CHECK_THROWS_AS(campaign.report(), InputError);
}

TEST_CASE("Columns of a metric that the campaign does not ask for say so") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(2), 0, 0.82, 0.2);
  const std::string words = "does not ask for the metric hellinger";
  CHECK_FALSE(mentions(campaign.report().at("report.md"), words));
  std::erase_if(campaign.plan.metrics, [](const Metric& metric) { return metric.name == MetricName::hellinger; });
  CHECK(mentions(campaign.report().at("report.md"), words));
}

TEST_CASE("A report is written from a store") {
  const auto folder =
      std::filesystem::temp_directory_path() / ("tamp_report_test_" + std::to_string(static_cast<long>(getpid())));
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(2), 0, 0.82, 0.2);
  Store store = Store::open(folder / "store", Store::Mode::create);
  for (const auto& [key, record] : campaign.records)
    store.put(record);
  const auto paths = write_report(campaign.plan, store, folder / "out" / "deep");
  const auto expected = campaign.report();
  CHECK(paths.size() == expected.size());
  for (const auto& path : paths) {
    CAPTURE(path.string());
    if (path.filename() == "index.html") // names the store's folder
      CHECK(mentions(read_file(path), "\"store\":\"" + (folder / "store").string() + "\""));
    else if (path.filename() == "report.md") // names the figures that are missing
      CHECK(mentions(read_file(path), "Figures that this campaign has no numbers for"));
    else
      CHECK(read_file(path) == expected.at(path.filename().string()));
  }

  campaign.plan_job(paper_scene(2), 1);
  write_report(campaign.plan, store, folder / "out" / "deep");
  const std::string page = read_file(folder / "out" / "deep" / "report.md");
  CHECK(mentions(page, "To run them: tamp run campaigns/synthetic.json --store "));
  std::filesystem::remove_all(folder);
}

TEST_CASE("Ten thousand records that are read make a report in under 20 s of processor time", "[slow]") {
  SyntheticCampaign campaign; // 7 records a packing
  for (int i = 0; i < 1430; ++i)
    campaign.add_ok(paper_scene(2 + i % 2), i, 0.63 + 1e-5 * i, 1.0 + i % 7, "method " + std::to_string(i % 20 / 2));
  REQUIRE(campaign.records.size() > 10000);
  const std::clock_t start = std::clock();
  const auto files = campaign.report();
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  CAPTURE(seconds);
  CHECK(files.at("lognormal_2d_records.csv").size() > 100000);
  CHECK(seconds < 20);
}
