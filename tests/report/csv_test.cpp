// CSV output read back by a parser written from RFC 4180.
#include "report/csv.h"
#include "tests/report/csv_reader.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdlib>

using namespace tamp;
using namespace tamp::test;

TEST_CASE("Any field reads back") {
  const std::array<std::string, 5> fields = {"plain", "a,b", "say \"x\"", "two\nlines", ""};
  const auto rows = read_csv(csv_record(fields));
  REQUIRE(rows.size() == 1);
  CHECK(rows[0] == std::vector<std::string>(fields.begin(), fields.end()));
}

TEST_CASE("Numbers read back as the same double") {
  for (const double value : {0.1, 1.0 / 3.0, 1.5e-14, 20654.0, -2e300})
    CHECK(std::strtod(csv_number(value).c_str(), nullptr) == value);
  CHECK(csv_number(Cell::kNone).empty());
}

TEST_CASE("The table's file holds the exact figures") {
  SyntheticCampaign campaign;
  for (int i = 0; i < 3; ++i)
    campaign.add_ok(paper_scene(2), i, 0.82 + 0.001 * i, 0.2);
  const auto rows = read_csv(campaign.report().at("lognormal_2d.csv"));
  REQUIRE(rows.size() > 10);
  CHECK(rows[0] ==
        std::vector<std::string>{"table", "panel", "method", "source", "quantity", "unit", "value", "sd", "n"});
  std::map<std::string, std::vector<std::string>> by_name;
  for (const auto& row : rows) {
    REQUIRE(row.size() == 9);
    by_name[row[3] + "/" + row[4]] = row;
  }
  const auto& run = by_name.at("this run/phi_paper");
  CHECK(run[2] == "D&R");
  CHECK(std::strtod(run[6].c_str(), nullptr) == Approx(0.821));
  CHECK(std::strtod(run[7].c_str(), nullptr) == Approx(0.001));
  CHECK(run[8] == "3");
  CHECK(by_name.at("paper/phi_paper")[6] == "0.811");
  CHECK(by_name.at("paper/phi_paper")[8].empty());
  CHECK(std::strtod(by_name.at("difference/phi_paper")[6].c_str(), nullptr) == Approx(0.01));
  CHECK(by_name.at("paper/time")[5] == "s");
  CHECK(std::strtod(by_name.at("difference/time of the paper / time of this run")[6].c_str(), nullptr) ==
        Approx(4.65 / 0.2));
  CHECK(by_name.at("this run/overlap_max")[6] == "4.5e-14"); // the worst of the three
}

TEST_CASE("The decision's file names scene, need, and who is best and next, in units of their own") {
  SyntheticCampaign campaign;
  for (int i = 0; i < 3; ++i) {
    campaign.add_ok(paper_scene(3), i, 0.63 + 0.001 * i, 1.0, "A");
    campaign.add_ok(paper_scene(3), 10 + i, 0.60 + 0.001 * i, 2.0 + 0.1 * i, "B");
  }
  std::map<std::string, std::vector<std::string>> by_name;
  for (const auto& row : read_csv(campaign.report().at("decision.csv")))
    by_name[row[2] + "/" + row[4]] = row;
  const std::string densest = "densest: phi";
  CHECK(by_name.at(densest + "/best")[6] == "A");
  CHECK(by_name.at(densest + "/next")[6] == "B");
  CHECK(by_name.at(densest + "/best")[1].find("lognormal powder in 3D, box 133") != std::string::npos);
  CHECK(std::strtod(by_name.at(densest + "/best value")[6].c_str(), nullptr) >
        std::strtod(by_name.at(densest + "/next value")[6].c_str(), nullptr));
  CHECK(by_name.at(densest + "/best value")[5] == "1");
  CHECK(by_name.at("fastest: time per sphere (µs)/best value")[5] == "us");
  CHECK(by_name.at(densest + "/told apart")[6].find("yes") == 0);
}

TEST_CASE("The file of records has each record once") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(3), 0, 0.63, 1);
  campaign.plan_job(paper_scene(3), 1);
  const auto rows = read_csv(campaign.report().at("lognormal_3d_records.csv"));
  REQUIRE(rows.size() == 1 + 1 + campaign.plan.metrics.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    CHECK(rows[i].size() == rows[0].size());
    CHECK(campaign.records.count(rows[i][0]) == 1);
  }
}
