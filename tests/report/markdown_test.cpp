// Markdown output: shape of the grids, escapes.
#include "report/markdown.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

using namespace tamp;
using namespace tamp::test;

namespace {

std::size_t bars(const std::string& line) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < line.size(); ++i)
    count += line[i] == '|' && (i == 0 || line[i - 1] != '\\') ? 1 : 0;
  return count;
}

} // namespace

TEST_CASE("Text means nothing to Markdown") {
  CHECK(markdown_text("a|b *c* _d_ <e> `f`") == "a\\|b \\*c\\* \\_d\\_ \\<e\\> \\`f\\`");
  CHECK(markdown_text("two\nlines") == "two lines");
}

TEST_CASE("All rows of a grid have the same number of cells") {
  SyntheticCampaign campaign;
  for (int i = 0; i < 3; ++i)
    campaign.add_ok(paper_scene(2), i, 0.82, 0.2, "D|R");
  campaign.add_ok(paper_scene(3), 0, 0.63, 1);
  const std::string page = campaign.report().at("report.md");
  std::istringstream lines(page);
  std::string line;
  std::size_t expected = 0;
  int grids = 0;
  int rows = 0;
  while (std::getline(lines, line)) {
    if (!line.starts_with("|")) {
      expected = 0;
      continue;
    }
    if (expected == 0) {
      expected = bars(line);
      ++grids;
    }
    CAPTURE(line);
    CHECK(bars(line) == expected);
    ++rows;
  }
  CHECK(grids == 4);
  CHECK(rows == (2 + 3) + (2 + 1) + (2 + 3) + (2 + 1));
  CHECK(page.starts_with("# A synthetic campaign\n"));
  CHECK(page.find("## lognormal\\_2d") != std::string::npos);
  CHECK(page.find("- **Build.** commit 0123456789ab, GNU 12.2.0") != std::string::npos);
}
