// The paper's figures in the code against the file of every number the paper prints.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/model/report_tables.h"
#include "report/number.h"
#include "report/paper_bimodal.h"
#include "report/paper_tables.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <filesystem>

using namespace tamp;

namespace {

Method with_effects(MethodName name, double friction, double adhesion) {
  Method method;
  method.name = name;
  method.material.friction = friction;
  method.material.adhesion = adhesion;
  return method;
}

nlohmann::json reference() {
  return nlohmann::json::parse(read_file(std::filesystem::path(TAMP_SOURCE_DIR) / "tests/report/paper_tables.json"));
}

/// Whether the value is one that its printed digits can say.
bool has_decimals(double value, int decimals) {
  const double scaled = value * std::pow(10.0, decimals);
  return std::abs(scaled - std::round(scaled)) < 1e-6;
}

} // namespace

TEST_CASE("Each row of the paper's tables is the one printed") {
  const nlohmann::json all = reference();
  for (const PaperTable& table : paper_tables()) {
    CAPTURE(table.name);
    const nlohmann::json& printed = all.at(std::string(table.name));
    CHECK(table.edge_um == printed.at("X_um"));
    REQUIRE(table.rows.size() == printed.at("rows").size());
    for (const nlohmann::json& row : printed.at("rows")) {
      CAPTURE(row.dump());
      const PaperRow* ours = table.find(row[0].get<std::string>());
      REQUIRE(ours);
      CHECK(ours->particles == row[1]);
      CHECK(ours->hellinger_number.value == row[2]);
      CHECK(ours->hellinger_weighted.value == row[3]);
      CHECK(ours->phi.value == row[4]);
      CHECK(ours->particles_in_sub_box == row[5]);
      CHECK(ours->time_s.value == row[6]);
      for (const Printed& number : {ours->hellinger_number, ours->hellinger_weighted, ours->phi})
        CHECK(has_decimals(number.value, number.decimals));
      CHECK(has_decimals(ours->time_s.value / time_unit(ours->time_s.value).seconds, ours->time_s.decimals));
    }
    CHECK(table.mu_ln == all["psd"]["mu_ln"]);
    CHECK(table.sigma_ln == all["psd"]["sigma_ln"]);
    CHECK(table.r_min_um == all["psd"]["r_min_um"]);
    CHECK(table.r_max_um == all["psd"]["r_max_um"]);
  }
}

TEST_CASE("Tables are found by name, rows by that which the paper has") {
  CHECK(paper_table("lognormal_3d").dimension == 3);
  CHECK_THROWS_AS(paper_table("bimodal"), InputError);
  CHECK(paper_table("lognormal_2d").find("D&R-XY") == nullptr);
  for (const PaperTable& table : paper_tables())
    CHECK(is_report_table(table.name));
}

TEST_CASE("Each row of the paper's table of mixtures is the one printed") {
  const nlohmann::json all = reference();
  const nlohmann::json& printed = all.at("bimodal_3d");
  CHECK(printed.at("X_L") == kPaperBimodalFraction);
  std::size_t rows = 0;
  for (const nlohmann::json& row : printed.at("rows")) {
    CAPTURE(row.dump());
    const std::vector<double> ratios =
        row[1].is_array() ? row[1].get<std::vector<double>>() : std::vector<double>{row[1].get<double>()};
    for (const double ratio : ratios) {
      ++rows;
      const PaperBimodalRow* ours = find_paper_bimodal(row[0].get<std::string>(), ratio);
      REQUIRE(ours);
      CHECK(ours->outcome == row[7].get<std::string>());
      CHECK(ours->has_figures() == row[2].is_number());
      if (!ours->has_figures())
        continue;
      CHECK(ours->particles == row[2]);
      CHECK(ours->large_share.value == row[3]);
      CHECK(ours->large == row[4]);
      CHECK(ours->phi.value == row[5]);
      CHECK(ours->time_s.value == row[6]);
    }
  }
  CHECK(paper_bimodal_rows().size() == rows);
}

TEST_CASE("Which row of the paper a method stands beside is decided by what runs") {
  struct Expected {
    MethodName name;
    double friction;
    double adhesion;
    const char* lognormal;
    const char* bimodal;
  };
  constexpr std::array kExpected = {
      Expected{MethodName::drop_and_roll, 0, 0, "D&R", "D&R"},
      Expected{MethodName::drop_and_roll_me, 0, 0, "D&R-ME", ""},
      Expected{MethodName::dem_isostatic, 0, 0, "dp3D_NANF", "dp3D"},
      Expected{MethodName::dem_isostatic, 0.5, 0.004, "dp3D_Lee2018", ""},
      Expected{MethodName::dem_isostatic, 0.5, 0, "", ""},
      Expected{MethodName::dem_isostatic, 0, 0.004, "", ""},
      Expected{MethodName::dem_gravity, 0, 0, "LAMMPS_NANF", "LAMMPS"},
      Expected{MethodName::dem_gravity, 0.5, 0, "LAMMPS_Lee2018", ""},
      Expected{MethodName::lammps_gravity, 0, 0, "LAMMPS_NANF", "LAMMPS"},
      Expected{MethodName::lammps_gravity, 0.5, 0.004, "LAMMPS_Lee2018", ""},
      Expected{MethodName::lammps_gravity, 0, 0.004, "", ""},
      Expected{MethodName::lammps_isostatic, 0, 0, "", ""},
      Expected{MethodName::lattice, 0, 0, "", ""},
  };
  for (const auto& [name, friction, adhesion, lognormal, bimodal] : kExpected) {
    const Method method = with_effects(name, friction, adhesion);
    CAPTURE(name_of(name), friction, adhesion);
    CHECK(paper_method(method).lognormal == lognormal);
    CHECK(paper_method(method).bimodal == bimodal);
    const PaperRow* row = paper_table("lognormal_3d").find(method);
    CHECK((row ? row->method : "") == lognormal);
    CHECK((find_paper_bimodal(method, 5) != nullptr) == (*bimodal != 0));
  }
  Method to_a_density = with_effects(MethodName::dem_isostatic, 0, 0);
  to_a_density.dem_isostatic.target_phi = 0.62;
  CHECK(paper_method(to_a_density).lognormal.empty());
}

TEST_CASE("What a method does otherwise than the paper's is told") {
  Method method;
  CHECK(other_protocol(method).empty());
  method.drop_and_roll.on_failure = OnFailure::keep;
  method.drop_and_roll.max_failures = 5;
  CHECK(other_protocol(method) == "on_failure keep, max_failures 5");
  method.name = MethodName::drop_and_roll_me;
  CHECK(other_protocol(method).empty());
}
