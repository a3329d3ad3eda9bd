// The packings of a page: base64, the slab that is shown of a large one, the budget, and what is said of the rest.
#include "engine/base/error.h"
#include "report/base64.h"
#include "report/page_assets.h"
#include "report/page_packings.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;

namespace {

/// A column of n spheres of radius 1, each standing on the next lower one.
Packing column(std::size_t n, Boundary vertical = Boundary::wall) {
  Packing packing;
  packing.size = {2, 2, 2.0 * static_cast<double>(n)};
  packing.boundary = {Boundary::wall, Boundary::wall, vertical};
  for (std::size_t i = 0; i < n; ++i) {
    packing.positions.insert(packing.positions.end(), {1, 1, 1 + 2.0 * static_cast<double>(i)});
    packing.radii.push_back(1);
  }
  return packing;
}

std::string section(const SyntheticCampaign& campaign, const std::function<Packing(const std::string&)>& packing) {
  const auto runs = campaign.runs();
  return packings_section({campaign.plan, runs, "tamp run", "a-store", packing});
}

std::size_t count_of(const std::string& text, std::string_view word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++n;
  return n;
}

} // namespace

TEST_CASE("Doubles become base64 as RFC 4648 has it, for each length of the last group") {
  CHECK(base64_of({}).empty());
  CHECK(base64_of(std::vector<double>{1}) == "AAAAAAAA8D8=");
  CHECK(base64_of(std::vector<double>{1, -2.5}) == "AAAAAAAA8D8AAAAAAAAEwA==");
  CHECK(base64_of(std::vector<double>{1, -2.5, 0.1}) == "AAAAAAAA8D8AAAAAAAAEwJqZmZmZmbk/");
}

TEST_CASE("Of a large packing the lowest slab is shown, with every sphere that reaches into it") {
  const Packing packing = column(10);
  const ShownPart all = shown_part(packing, 10);
  CHECK(all.spheres.size() == 10);
  CHECK(all.height == 20);
  const ShownPart part = shown_part(packing, 4);
  CHECK(part.height == 8); // the fifth sphere stands there
  CHECK(part.spheres == std::vector<std::size_t>{0, 1, 2, 3});
}

TEST_CASE("A sphere that reaches over a periodic lid belongs to the slab at the floor") {
  Packing packing = column(10, Boundary::periodic);
  packing.positions.back() += 0.5;
  const ShownPart part = shown_part(packing, 4);
  CHECK(part.spheres == std::vector<std::size_t>{0, 1, 2, 9});
  CHECK(part.height == 6);
}

TEST_CASE("A page shows first replicates first, until its budget is spent, and says what it leaves out") {
  SyntheticCampaign campaign; // each run states some 20 000 spheres
  for (int i = 0; i < 15; ++i)
    campaign.add_ok(paper_scene(3), i, 0.6, 1);
  const std::string page = section(campaign, [](const std::string&) { return column(20000); });
  if (kThreeJs.empty()) {
    CHECK(page.find("libjs-three") != std::string::npos);
    return;
  }
  CHECK(count_of(page, "class=\"packing\"") == 12); // of some 20 000 each; no room for the thirteenth
  CHECK(page.find("3 further packings are not on this page, which holds 250000 spheres") != std::string::npos);
  CHECK(page.find("data-gap=\"0.000001\"") != std::string::npos);
  CHECK(page.find("Permission is hereby granted") != std::string::npos);
}

TEST_CASE("A packing that cannot be read is told, and the others are shown") {
  SyntheticCampaign campaign;
  const std::string lost = campaign.add_ok(paper_scene(3), 0, 0.6, 1);
  campaign.add_ok(paper_scene(3), 1, 0.6, 1);
  const std::string page = section(campaign, [&](const std::string& key) {
    if (key == lost)
      throw Error("packing <gone>");
    return column(3);
  });
  if (!kThreeJs.empty()) {
    CHECK(count_of(page, "class=\"packing\"") == 1);
    CHECK(page.find("cannot be shown: packing &lt;gone&gt;") != std::string::npos);
  }
}

TEST_CASE("Without a run that ended ok there is no section of packings") {
  SyntheticCampaign campaign;
  campaign.plan_job(paper_scene(3), 0);
  CHECK(section(campaign, [](const std::string&) { return column(1); }).empty());
}
