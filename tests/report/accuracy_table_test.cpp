// What accuracy costs: families of one knob, errors from the limit, the front, the place of the default.
#include "report/accuracy_table.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr std::array kBalances = {0.08, 0.04, 0.02, 0.01, 0.005};
constexpr int kReplicates = 6;

/// Beds that start from the packings of another method: phi = 0.64 - 0.1 force_balance + scatter of the start + noise.
struct Knobs : SyntheticCampaign {
  Knobs() { plan.report.tables = {"accuracy"}; }

  void add_start(int replicate) { starts.push_back(add_ok(paper_scene(3), replicate, 0.6, 1, "D&R")); }

  std::string add(const Method& method, int replicate, double phi, double seconds, const std::string& label,
                  const std::string& parent) {
    return add_ok(paper_scene(3), replicate, phi - 0.01, seconds, label, method, parent);
  }

  void add_balances(double slope, double noise, double scatter, bool from_start) {
    if (from_start && starts.empty()) {
      for (int i = 0; i < kReplicates; ++i)
        add_start(i);
    }
    for (const double balance : kBalances) {
      Method method = method_named(MethodName::dem_gravity);
      method.dem_gravity.force_balance = balance;
      for (int i = 0; i < kReplicates; ++i) {
        const double own = scatter * (i % 2 == 0 ? 1 : -1);
        const double chance = noise * std::sin(100 * balance + 7.0 * i);
        add(method, i, 0.64 + slope * balance + own + chance, 0.1 / balance, "gravity",
            from_start ? starts.at(static_cast<std::size_t>(i)) : "");
      }
    }
  }

  [[nodiscard]] std::vector<KnobFamily> families() const {
    const auto joined = runs();
    return knob_families(joined);
  }

  std::vector<std::string> starts;
};

} // namespace

TEST_CASE("groups that differ in one knob are a family, from coarse to fine, with its default marked", "[report]") {
  Knobs campaign;
  campaign.add_balances(-0.1, 1e-4, 0, true);
  Method other = method_named(MethodName::dem_gravity);
  other.material.friction = 0.5; // physics, no knob
  campaign.add(other, 0, 0.6, 1, "gravity", campaign.starts[0]);
  other.dem_gravity.overlap = 0.01;
  campaign.add(other, 0, 0.6, 1, "gravity", campaign.starts[0]);
  const auto families = campaign.families();
  REQUIRE(families.size() == 1);
  CHECK(families[0].label == "gravity");
  CHECK(families[0].knob->path == "method/force_balance");
  REQUIRE(families[0].levels.size() == kBalances.size());
  for (std::size_t i = 0; i < kBalances.size(); ++i) {
    CHECK(families[0].levels[i].value == kBalances[i]);
    CHECK(families[0].levels[i].is_default == (kBalances[i] == Method{}.dem_gravity.force_balance));
  }
}

TEST_CASE("of boxes that grow with their number of particles the number is the knob, finer where larger", "[report]") {
  Knobs campaign;
  for (const int count : {4000, 1000, 2000}) {
    Scene scene = paper_scene(3);
    scene.count = count;
    scene.size = {std::cbrt(count), std::cbrt(count), std::cbrt(count)};
    campaign.add_ok(scene, 0, 0.6, 1);
  }
  const auto families = campaign.families();
  REQUIRE(families.size() == 1);
  CHECK(families[0].levels.front().value == 1000);
  CHECK(families[0].levels.back().value == 4000);
}

TEST_CASE("packings from common starts are compared pair by pair, so their scatter does not hide a knob", "[report]") {
  Knobs paired;
  paired.add_balances(-0.1, 1e-4, 0.01, true);
  const auto of_pairs = paired.families();
  const auto effect = knob_effect(of_pairs.at(0), "phi");
  REQUIRE(effect);
  CHECK(effect->paired);
  REQUIRE(effect->order.found());
  CHECK(effect->order.order_low < 1);
  CHECK(effect->order.order_high > 1);
  CHECK(effect->reference == Approx(0.64).margin(5e-4));
  CHECK(effect->error[0].value == Approx(-0.008).margin(5e-4));
  CHECK(effect->error[0].half_width < 1e-3);

  Knobs independent;
  independent.add_balances(-0.1, 1e-4, 0.01, false);
  const auto of_others = independent.families();
  const auto hidden = knob_effect(of_others.at(0), "phi");
  REQUIRE(hidden);
  CHECK_FALSE(hidden->paired);
  CHECK(hidden->order.why_none == "no change beyond the scatter");
  CHECK(hidden->error[0].half_width > 0.008);
}

TEST_CASE("without an order the finest level is the reference, and one replicate says nothing", "[report]") {
  Knobs flat;
  flat.add_balances(0, 1e-4, 0, true);
  const auto families = flat.families();
  const auto effect = knob_effect(families.at(0), "phi");
  REQUIRE(effect);
  CHECK_FALSE(effect->order.found());
  CHECK(effect->error.back().value == 0);
  CHECK(effect->error.back().half_width > 0);

  Knobs single;
  for (const double balance : kBalances) {
    Method method = method_named(MethodName::dem_gravity);
    method.dem_gravity.force_balance = balance;
    single.add(method, 0, 0.64, 1, "gravity", "");
  }
  const auto alone = single.families();
  CHECK_FALSE(knob_effect(alone.at(0), "phi"));
}

TEST_CASE("the front is what no other setting beats, and the cheapest setting is the fastest that is exact enough",
          "[report]") {
  const std::vector<Setting> settings = {{nullptr, 0, 1, 0.1},
                                         {nullptr, 1, 2, 0.01},
                                         {nullptr, 2, 3, 0.02}, // slower and worse than 1
                                         {nullptr, 3, 10, 0.001}};
  const auto front = front_of(settings);
  REQUIRE(front.size() == 3);
  CHECK(front[1].level == 1);
  CHECK(front[2].level == 3);
  CHECK(settings[2].beaten_by(settings[1]));
  CHECK_FALSE(settings[1].beaten_by(settings[2]));
  CHECK(cheapest(settings, 0.03)->level == 1);
  CHECK(cheapest(settings, 0.001)->level == 3);
  CHECK(cheapest(settings, 0.0001) == nullptr);
}

TEST_CASE("the table shows every level, and of every knob order, default and cheapest settings", "[report]") {
  Knobs campaign;
  campaign.add_balances(-0.1, 1e-5, 0.01, true);
  const auto families = campaign.families();
  const Table table = accuracy_table(families);
  REQUIRE(table.panels.size() == 2);
  CHECK(table.panels[0].groups.size() == kBalances.size());
  CHECK(table.panels[0].groups.back().heading == "gravity: force_balance = 0.005 (default)");
  REQUIRE(table.panels[1].groups.size() == 1);
  const auto cell = [&](std::string_view quantity) {
    const Panel& panel = table.panels[1];
    const auto at = std::find_if(panel.columns.begin(), panel.columns.end(),
                                 [&](const Column& column) { return column.quantity == quantity; });
    REQUIRE(at != panel.columns.end());
    return panel.groups[0].lines[0].cells[static_cast<std::size_t>(at - panel.columns.begin())];
  };
  CHECK(cell("phi_reference").value == Approx(0.64).margin(5e-4));
  CHECK(cell("default").value == 0.005);
  CHECK(cell("on the front").word == "yes");
  // 0.1 * 0.04 / 0.64 is 0.6 %, 0.08 is 1.25 %; times from the start on: 1 s + 0.1 s / balance.
  CHECK(cell("for 1 %").word == "0.04 (3.50 s)");
  CHECK(cell("for 0.1 %").word != "none shown");
  const auto files = campaign.report();
  CHECK(files.count("accuracy.tex") == 1);
  CHECK(files.count("accuracy.csv") == 1);
}
