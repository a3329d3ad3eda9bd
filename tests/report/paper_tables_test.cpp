// The paper's figures in the code against the file of every number the paper prints.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/model/report_tables.h"
#include "report/number.h"
#include "report/paper_bimodal.h"
#include "report/paper_tables.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

using namespace tamp;

namespace {

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

TEST_CASE("Tables are found by name, rows by label") {
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
