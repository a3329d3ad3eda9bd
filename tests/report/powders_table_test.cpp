// The table of powders against the closed forms of the lognormal law and of binary mixtures.
#include "report/powders_table.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tamp;
using namespace tamp::test;

namespace {

const Cell& cell_of(const Table& table, std::size_t row, std::string_view quantity) {
  const Panel& panel = table.panels.at(0);
  for (std::size_t i = 0; i < panel.columns.size(); ++i) {
    if (panel.columns[i].quantity == quantity)
      return panel.groups.at(row).lines.at(0).cells.at(i);
  }
  throw std::out_of_range("no such column");
}

} // namespace

TEST_CASE("each powder of a campaign has one row, with the moments and quantiles of its law") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(3), 0, 0.63, 1.0);
  campaign.add_ok(paper_scene(3), 1, 0.64, 1.0);
  Scene binary = paper_scene(3);
  binary.psd = {};
  binary.psd.law = Law::bimodal;
  binary.psd.small_radius = 2;
  binary.psd.size_ratio = 5;
  binary.psd.large_volume_fraction = 0.75;
  campaign.add_ok(binary, 0, 0.7, 1.0);
  const auto runs = campaign.runs();
  const Table table = powders_table(runs);
  REQUIRE(table.panels.at(0).groups.size() == 2);
  CHECK(cell_of(table, 0, "r_mean").value == Approx(std::exp(0.30 + 0.68 * 0.68 / 2)).epsilon(1e-3));
  CHECK(cell_of(table, 0, "r_50").value == Approx(std::exp(0.30)).epsilon(1e-3));
  CHECK(cell_of(table, 0, "r_90").value == Approx(std::exp(0.30 + 1.2815516 * 0.68)).epsilon(1e-3));
  // Weighting a lognormal law by r³ shifts its median by exp(3 σ²).
  CHECK(cell_of(table, 0, "r_50_weighted").value == Approx(std::exp(0.30 + 3 * 0.68 * 0.68)).epsilon(1e-2));
  CHECK(cell_of(table, 0, "phi_close").value == Approx(0.742).margin(2e-3));
  CHECK(cell_of(table, 1, "r_min").value == 2);
  CHECK(cell_of(table, 1, "r_max").value == 10);
  CHECK(cell_of(table, 1, "r_50").value == 2);
  CHECK(cell_of(table, 1, "r_50_weighted").value == 10);
}

TEST_CASE("The paper's powder is explained where a lognormal one occurs, and only there") {
  SyntheticCampaign campaign;
  Scene binary = paper_scene(3);
  binary.psd = {};
  binary.psd.law = Law::bimodal;
  binary.psd.small_radius = 2;
  binary.psd.size_ratio = 5;
  binary.psd.large_volume_fraction = 0.75;
  campaign.add_ok(binary, 0, 0.7, 1.0);
  CHECK(powders_table(campaign.runs()).notes.size() == 1);
  campaign.add_ok(paper_scene(3), 0, 0.63, 1.0);
  const auto notes = powders_table(campaign.runs()).notes;
  REQUIRE(notes.size() == 2);
  CHECK(notes[1].heading == "The paper's powder");
}

TEST_CASE("The words of a law are in the unit of its row") {
  SyntheticCampaign campaign;
  Scene nano = paper_scene(3);
  nano.unit = LengthUnit::nm;
  for (double& edge : nano.size)
    edge *= 1000;
  nano.psd.mu_ln += std::log(1000.0);
  nano.psd.r_min *= 1000;
  nano.psd.r_max *= 1000;
  campaign.add_ok(nano, 0, 0.63, 1.0);
  nano.psd = {};
  nano.psd.law = Law::weibull;
  nano.psd.scale = 20;
  nano.psd.shape = 2;
  nano.psd.r_min = 1;
  nano.psd.r_max = 80;
  campaign.add_ok(nano, 0, 0.63, 1.0);
  const auto runs = campaign.runs();
  const Table table = powders_table(runs);
  CHECK(table.panels.at(0).groups.at(0).heading == "lognormal, ⟨mu_ln⟩ = 0.3, ⟨sigma_ln⟩ = 0.68 (3D)");
  CHECK(cell_of(table, 0, "r_50").value == Approx(std::exp(0.30)).epsilon(1e-3));
  CHECK(table.panels[0].groups.at(1).heading == "Weibull, scale 0.02 µm, shape 2 (3D)");
  CHECK(cell_of(table, 1, "r_max").value == Approx(0.08));
}
