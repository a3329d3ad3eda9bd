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
  CHECK(files.at("lognormal_2d.csv") == "table,method,source,quantity,unit,value,sd,n\n");
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

TEST_CASE("Times of the two modes are never mixed") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(2), 0, 0.82, 0.2);
  const std::string shared = campaign.add_ok(paper_scene(2), 1, 0.82, 5);
  campaign.records[shared].timing.mode = TimingMode::shared;
  CHECK(cell_of(table_of(campaign, "lognormal_2d"), 0, 0, "time").value == 0.2);
  CHECK(cell_of(table_of(campaign, "lognormal_2d"), 0, 0, "time").n == 1);
  CHECK(mentions(campaign.report().at("report.md"), "1 of the 2 replicates"));
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
  CHECK(table.panels[0].groups[1].lines.size() == 3); // the paper's row is found by the label alone
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
    else
      CHECK(read_file(path) == expected.at(path.filename().string()));
  }

  campaign.plan_job(paper_scene(2), 1);
  write_report(campaign.plan, store, folder / "out" / "deep");
  const std::string page = read_file(folder / "out" / "deep" / "report.md");
  CHECK(mentions(page, "To run them: tamp run campaigns/synthetic.json --store "));
  std::filesystem::remove_all(folder);
}
