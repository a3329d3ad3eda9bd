// Tables of binary mixtures: lines beside the paper's, outcomes in words, the Furnas plane.
#include "report/bimodal_tables.h"
#include "report/paper_bimodal.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tamp;
using namespace tamp::test;

namespace {

Scene mixture(double size_ratio, double fraction = 0.75) {
  Scene scene;
  scene.size = {100};
  scene.psd.law = Law::bimodal;
  scene.psd.small_radius = 1;
  scene.psd.size_ratio = size_ratio;
  scene.psd.large_volume_fraction = fraction;
  return completed(scene);
}

struct Mixtures : SyntheticCampaign {
  Mixtures() {
    plan.report.tables = {"bimodal_3d", "furnas"};
    plan.metrics.push_back({MetricName::composition});
  }
  std::string add(const Scene& scene, std::int64_t replicate, double phi_paper, double reached,
                  const std::string& label = "D&R", const Method& method = {}) {
    const std::string key = add_ok(scene, replicate, phi_paper, 2, label, method);
    add_metric(key, 6, {{"N_L", 100}, {"X_L", reached}, {"P_NL", 0.003}});
    return key;
  }
  [[nodiscard]] Table bimodal() const {
    const auto joined = runs();
    return bimodal_table(bimodal_groups(joined));
  }
  [[nodiscard]] Table furnas() const {
    const auto joined = runs();
    return furnas_table(bimodal_groups(joined));
  }
};

std::size_t column(const Panel& panel, std::string_view quantity) {
  for (std::size_t i = 0; i < panel.columns.size(); ++i) {
    if (panel.columns[i].quantity == quantity)
      return i;
  }
  FAIL("no column " << quantity);
  return 0;
}

bool mentions(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

} // namespace

TEST_CASE("A mixture stands beside the paper's row of its size ratio, sorted by it") {
  Mixtures campaign;
  campaign.add(mixture(10), 0, 0.730, 0.70);
  campaign.add(mixture(10), 1, 0.734, 0.72);
  campaign.add(mixture(1), 0, 0.571, 1);
  const Table table = campaign.bimodal();
  REQUIRE(table.panels.size() == 2);
  const Panel& compared = table.panels[0];
  REQUIRE(compared.groups.size() == 2);
  CHECK(compared.groups[0].heading == "D&R, ⟨rho⟩ = 1");
  const auto& lines = compared.groups[1].lines;
  REQUIRE(lines.size() == 3);
  const std::size_t phi = column(compared, "phi_paper");
  CHECK(lines[0].cells[phi].value == Approx(0.732));
  CHECK(lines[0].cells[phi].n == 2);
  CHECK(lines[1].cells[phi].value == 0.720);
  CHECK(lines[2].cells[phi].value == Approx(0.012));
  CHECK(lines[2].cells[column(compared, "time")].value == Approx(37.0 / 2));
  const Panel& own = table.panels[1];
  CHECK(own.groups[1].lines[0].cells[column(own, "X_L")].value == Approx(0.71));
  CHECK(mentions(campaign.report().at("bimodal_3d.csv"), ",\"D&R, rho = 10\",paper,phi_paper,1,0.72,,"));
}

TEST_CASE("Another fraction is another powder, but not at size ratio 1") {
  Mixtures campaign;
  campaign.add(mixture(10, 0.5), 0, 0.7, 0.5);
  campaign.add(mixture(1, 0.5), 0, 0.57, 1);
  const Table table = campaign.bimodal();
  CHECK(table.panels[0].groups[0].lines.size() == 3);
  CHECK(table.panels[0].groups[1].lines.size() == 1);
}

TEST_CASE("An outcome other than ok stands in the place of the figures, its reason below") {
  Mixtures campaign;
  const std::string key = campaign.add(mixture(40), 0, 0.7, 0.7);
  campaign.records[key].outcome = Outcome::memory_limited;
  campaign.records[key].reason = "more than 6000 MB";
  const Table table = campaign.bimodal();
  REQUIRE(table.panels.size() == 1); // nothing was measured
  const auto& lines = table.panels[0].groups.at(0).lines;
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].cells[0].word == "memory-limited");
  CHECK_FALSE(lines[0].cells[0].empty());
  CHECK(lines[0].cells[1].empty());
  const auto files = campaign.report();
  CHECK(mentions(files.at("report.md"), "| memory-limited |"));
  CHECK(mentions(files.at("report.md"), "more than 6000 MB"));
  CHECK(mentions(files.at("report.md"), "(0.644)")); // the paper's anomalous density
  CHECK(mentions(files.at("bimodal_3d.tex"), "(\\num{0.644})"));
  CHECK(mentions(files.at("bimodal_3d.tex"), "memory-{}limited"));
  CHECK(mentions(files.at("bimodal_3d.csv"), ",\"D&R, rho = 40\",this run,outcome,,memory-limited,,"));

  campaign.add(mixture(40), 1, 0.77, 0.7);
  const Table both = campaign.bimodal();
  CHECK(both.panels[0].groups[0].remark == "n = 1; other runs: memory-limited");
  CHECK(both.panels[0].groups[0].lines[0].cells[column(both.panels[0], "phi_paper")].value == Approx(0.77));
}

TEST_CASE("What the paper could not run is said in its words") {
  Mixtures campaign;
  campaign.add(mixture(20), 0, 0.8, 0.7, "any name", method_named(MethodName::dem_isostatic));
  const Table table = campaign.bimodal();
  const auto& lines = table.panels[0].groups[0].lines;
  REQUIRE(lines.size() == 2); // no difference
  CHECK(lines[1].cells[0].word == "memory-limited");
}

TEST_CASE("The Furnas plane has a cell for each fraction and size ratio") {
  Mixtures campaign;
  campaign.add(mixture(5, 0.3), 0, 0.60, 0.29);
  campaign.add(mixture(2, 0.6), 0, 0.61, 0.58);
  const std::string failed = campaign.add(mixture(5, 0.6), 0, 0.68, 0.55);
  campaign.records[failed].outcome = Outcome::time_limited;
  const Table table = campaign.furnas();
  REQUIRE(table.panels.size() == 3);
  const Panel& phi = table.panels[0];
  REQUIRE(phi.columns.size() == 2);
  REQUIRE(phi.groups.size() == 2);
  CHECK(phi.groups[0].heading == "D&R, ⟨X_L⟩ = 0.3");
  CHECK(phi.groups[0].lines[0].cells[0].empty()); // size ratio 2 has no such fraction
  CHECK(phi.groups[0].lines[0].cells[1].value == Approx(0.61));
  CHECK(phi.groups[1].lines[0].cells[0].value == Approx(0.62));
  CHECK(phi.groups[1].lines[0].cells[1].word == "time-limited");
  CHECK(table.panels[2].groups[0].lines[0].cells[1].value == Approx(0.29));
  CHECK(mentions(campaign.report().at("furnas.csv"), ",\"D&R, X_L = 0.3\",this run,phi at rho = 5,1,0.61"));
}

TEST_CASE("A campaign without mixtures gives tables that say so") {
  SyntheticCampaign campaign;
  campaign.plan.report.tables = {"bimodal_3d", "furnas"};
  campaign.add_ok(paper_scene(3), 0, 0.6, 1);
  CHECK(mentions(campaign.report().at("report.md"), "The campaign has no bimodal powder in 3D"));
}
