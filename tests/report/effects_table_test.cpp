// The table of effects: what ran of each method, and the time and density of kernels that simulate more than is called
// for.
#include "report/effects_table.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string_view>

using namespace tamp;
using namespace tamp::test;

namespace {

struct Ran : SyntheticCampaign {
  Ran() { plan.report.tables = {"effects"}; }

  void add(Simulate simulate, double seconds, double denser, const std::vector<std::string>& starts) {
    Method method = method_named(MethodName::dem_gravity);
    method.material.simulate = simulate;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const double scatter = 0.01 * static_cast<double>(i);
      const double noise = (i % 2 == 0 ? 1e-4 : -1e-4) * (simulate == Simulate::all ? 1 : -1);
      const std::string key = add_ok(paper_scene(3), static_cast<int>(i), 0.6 + scatter + denser + noise, seconds,
                                     "bed", method, starts[i]);
      Effects& effects = records[key].effects;
      effects.simulated = {"gravity"};
      effects.left_out = {{"inertia", "energy is minimised"}, {"friction", "mu = 0"}};
      if (simulate == Simulate::all)
        effects = {{"gravity", "inertia", "friction (mu = 0), with rotation"},
                   {{"rolling resistance", "no parameter"}}};
    }
  }

  [[nodiscard]] Table table() const {
    const auto joined = runs();
    return effects_table(joined);
  }
};

const Cell& cell_of(const Panel& panel, std::size_t group, std::string_view quantity, std::string_view remark = "") {
  for (std::size_t i = 0; i < panel.columns.size(); ++i) {
    if (panel.columns[i].quantity == quantity && (remark.empty() || panel.columns[i].remark == remark))
      return panel.groups.at(group).lines.at(0).cells.at(i);
  }
  FAIL("no column " << quantity << " " << remark);
  return panel.groups.at(0).lines.at(0).cells.at(0);
}

} // namespace

TEST_CASE("the ledger tells of each method what ran, and the savings are ratios of whole ways", "[report]") {
  Ran campaign;
  std::vector<std::string> starts;
  for (int i = 0; i < 4; ++i)
    starts.push_back(campaign.add_ok(paper_scene(3), i, 0.58, 1, "D&R"));
  campaign.add(Simulate::called_for, 3, 0, starts);
  campaign.add(Simulate::all, 15, 0.002, starts);
  const Table table = campaign.table();
  REQUIRE(table.panels.size() == 2);
  const Panel& ran = table.panels[0];
  REQUIRE(ran.groups.size() == 2);
  CHECK(ran.groups[0].heading == "bed");
  CHECK(ran.groups[1].heading == "bed (all)");
  CHECK(cell_of(ran, 0, "friction").word == "no");
  CHECK(cell_of(ran, 1, "friction").word == "yes");
  CHECK(cell_of(ran, 1, "rotation").word == "yes");
  CHECK(cell_of(ran, 0, "gravity").word == "yes");
  const Panel& savings = table.panels[1];
  REQUIRE(savings.groups.size() == 1);
  CHECK(cell_of(savings, 0, "ratio").value == Approx(16.0 / 4));
  // Scatter of the starts, 0.01 from one to the next, is common to both.
  const Cell& denser = cell_of(savings, 0, "phi_difference");
  CHECK(denser.value == Approx(0.002));
  CHECK(denser.spread < 1e-3);
  CHECK(table.notes.at(0).text.find("friction (mu = 0)") != std::string::npos);
}

TEST_CASE("a campaign that never asks for more than is called for has no savings", "[report]") {
  Ran campaign;
  campaign.add(Simulate::called_for, 3, 0, {"", ""});
  const Table table = campaign.table();
  REQUIRE(table.panels.size() == 1);
  CHECK(campaign.report().count("effects.tex") == 1);
}
