// The page and the decision table: who wins, what is escaped, which runs stand behind a number.
#include "report/decision_table.h"
#include "report/html.h"
#include "report/page.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <regex>

using namespace tamp;
using namespace tamp::test;

namespace {

/// Two methods on one scene: A fast and loose, B slow and dense, each twice.
SyntheticCampaign two_methods() {
  SyntheticCampaign campaign;
  for (int i = 0; i < 2; ++i) {
    campaign.add_ok(paper_scene(3), i, 0.60 + 0.001 * i, 1.0 + 0.01 * i, "A");
    Job job;
    job.scene = paper_scene(3);
    job.seed = 7; // other keys for the other label
    PlannedJob planned{job, "", "B", {}};
    planned.job.replicate = i;
    planned.key = job_key(planned.job);
    campaign.plan.jobs.push_back(planned);
    Record& record = campaign.add_record(planned.key, JobKind::generation, "drop-and-roll");
    record.measures = {{"N", 20000, "1"}};
    record.timing = {TimingMode::exclusive, 9.0 + i, 9, 9, 9, 1};
    campaign.add_metric(planned.key, 0, {{"H_V", 0.15}, {"H_V_floor", 0.16}});
    campaign.add_metric(planned.key, 1, {{"phi", 0.70 + 0.001 * i}});
  }
  return campaign;
}

const Group::Line& need(const Table& table, std::string_view name) {
  for (const Group& group : table.panels.at(0).groups) {
    if (group.heading.starts_with(name))
      return group.lines.at(0);
  }
  throw std::runtime_error("no such need");
}

} // namespace

TEST_CASE("The decision table names the best and the next, and whether they can be told apart") {
  const SyntheticCampaign campaign = two_methods();
  const auto runs = campaign.runs();
  const Table table = decision_table(runs);
  REQUIRE(table.panels.size() == 1);
  CHECK(need(table, "fastest").cells.at(0).word == "A");
  CHECK(need(table, "densest").cells.at(0).word == "B");
  CHECK(need(table, "densest").cells.at(1).value == Approx(0.7005));
  CHECK(need(table, "densest").cells.at(3).value == Approx(0.6105));
  CHECK(need(table, "densest").cells.at(4).word == "yes");
  CHECK(need(table, "densest").cells.at(1).keys.size() == 2);
  CHECK(need(table, "most faithful").cells.at(4).word == "no"); // both have the same H
}

TEST_CASE("Times taken beside other jobs decide nothing, and one method alone is no choice") {
  SyntheticCampaign campaign = two_methods();
  for (auto& [key, record] : campaign.records)
    record.timing.mode = TimingMode::shared;
  CHECK_THROWS(need(decision_table(campaign.runs()), "fastest"));
  SyntheticCampaign alone;
  alone.add_ok(paper_scene(3), 0, 0.6, 1);
  CHECK(decision_table(alone.runs()).panels.empty());
}

TEST_CASE("Every key that a cell names is among the page's runs, with seed, commit and job") {
  const SyntheticCampaign campaign = two_methods();
  const std::string page = campaign.report().at("index.html");
  const std::regex cell("data-k=\"([^\"]+)\"");
  std::size_t cells = 0;
  for (auto match = std::sregex_iterator(page.begin(), page.end(), cell); match != std::sregex_iterator(); ++match) {
    const std::string keys = (*match)[1];
    for (std::size_t at = 0; at < keys.size(); at += 65) // 64 digits and a blank
      CHECK(page.find('"' + keys.substr(at, 64) + "\":{\"method\":") != std::string::npos);
    ++cells;
  }
  CHECK(cells > 10);
  CHECK(page.find("\"seed\":7,\"replicate\":1") != std::string::npos);
  CHECK(page.find("\"commit\":\"0123456789abcdef") != std::string::npos);
  CHECK(page.find("<script src") == std::string::npos);
  CHECK(page.find("http") == std::string::npos); // no network
}

TEST_CASE("Nothing of a campaign can become a mark or a script of the page") {
  SyntheticCampaign campaign;
  campaign.plan.title = "<b>a</b> & \"b\"";
  campaign.add_ok(paper_scene(2), 0, 0.8, 1, "</script><script>alert(1)</script>");
  const std::string page = campaign.report().at("index.html");
  CHECK(page.find("<script>alert") == std::string::npos);
  CHECK(page.find("<title>&lt;b&gt;a&lt;/b&gt; &amp; &quot;b&quot;</title>") != std::string::npos);
}

TEST_CASE("What has not run is counted, with the command that runs it") {
  SyntheticCampaign campaign;
  campaign.add_ok(paper_scene(2), 0, 0.8, 1);
  campaign.plan_job(paper_scene(2), 1);
  const std::string page = campaign.report().at("index.html");
  CHECK(page.find("2 packings asked for, 1 made, 0 ended otherwise, 1 not yet run") != std::string::npos);
  CHECK(page.find("<code>tamp run campaigns/synthetic.json</code>") != std::string::npos);
}
