// Expectations: what is kept, what is left out, what counts as moved.
#include "engine/base/error.h"
#include "report/expectation.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;

namespace {

SyntheticCampaign two_methods(double phi, double wall_s) {
  SyntheticCampaign campaign;
  for (int replicate = 0; replicate < 2; ++replicate) {
    campaign.add_ok(paper_scene(3), replicate, phi + 0.001 * replicate, wall_s, "D&R");
    campaign.add_ok(paper_scene(3), 10 + replicate, 0.7, wall_s, "D&R-ME, \"twice\"");
  }
  return campaign;
}

std::vector<Table> tables_of(const SyntheticCampaign& campaign) {
  const auto runs = campaign.runs();
  return report_tables({campaign.plan, runs, ""});
}

std::string written(const SyntheticCampaign& campaign) {
  return expectation_csv("synthetic", "1.0", campaign.runs(), tables_of(campaign));
}

} // namespace

TEST_CASE("An expectation holds for the tables it was made of, whatever the times") {
  const std::string file = written(two_methods(0.63, 1.0));
  CHECK_THAT(file, Contains("# version: 1.0\n# date: 2024-05-01\n# commit: 0123456789"));
  CHECK(file.find(",time") == file.npos);
  CHECK(file.find("fastest") == file.npos);
  const auto expected = read_expectation(file, "file");
  CHECK(expected.size() > 40);
  const ExpectationCheck check = check_expectation(expected, tables_of(two_methods(0.63, 7.0)));
  CHECK(check.moved.empty());
  CHECK(check.unforeseen.empty());
  CHECK(check.checked == expected.size());
}

TEST_CASE("What moved beyond its tolerance is told with both values") {
  const auto expected = read_expectation(written(two_methods(0.63, 1.0)), "file");
  CHECK(check_expectation(expected, tables_of(two_methods(0.63 + 1e-10, 1.0))).moved.empty());
  const ExpectationCheck check = check_expectation(expected, tables_of(two_methods(0.64, 1.0)));
  CHECK_FALSE(check.moved.empty());
  CHECK(check.missing_rows.empty());
  CHECK_THAT(in_words(check), Contains("D&R, this run: phi_paper: expected 0.6305") &&
                                  Contains("decision, lognormal powder in 3D, box 133"));
  CHECK_THAT(in_words(check), Contains("tolerance 1e-9"));
  CHECK(in_words(check).find("z: expected") == std::string::npos);
  CHECK(in_words(check).find("⟨") == std::string::npos);
}

TEST_CASE("A row that is gone is named once, a new one is no fault") {
  const auto expected = read_expectation(written(two_methods(0.63, 1.0)), "file");
  SyntheticCampaign alone;
  for (int replicate = 0; replicate < 2; ++replicate)
    alone.add_ok(paper_scene(3), replicate, 0.63 + 0.001 * replicate, 1.0, "D&R");
  const std::string words = in_words(check_expectation(expected, tables_of(alone)));
  const std::string row = "D&R-ME, \"twice\", this run: the row is missing\n";
  CHECK_THAT(words, Contains(row));
  CHECK(words.find("this run: phi") == words.npos);

  const auto fewer = read_expectation(written(alone), "file");
  const ExpectationCheck check = check_expectation(fewer, tables_of(two_methods(0.63, 1.0)));
  CHECK(check.moved.empty());
  CHECK_FALSE(check.unforeseen.empty());
}

TEST_CASE("A file that is no expectation is refused by line") {
  const std::string header = "table,panel,row,column,expected,tolerance\n";
  CHECK_THROWS_WITH(read_expectation("a,b\n", "f.csv"), Contains("f.csv:1"));
  CHECK_THROWS_WITH(read_expectation(header + "a,b,c,d,1\n", "f.csv"), Contains("f.csv:2"));
  CHECK_THROWS_WITH(read_expectation(header + "a,b,c,d,1,-1\n", "f.csv"), Contains("f.csv:2"));
  CHECK_THROWS_WITH(read_expectation(header + "a,b,c,d,1,nan\n", "f.csv"), Contains("f.csv:2"));
  CHECK_THROWS_WITH(read_expectation(header, "f.csv"), Contains("expects nothing"));
}
