// Campaigns laid over others: what is inherited, replaced and taken away, and where mistakes of either are told.
#include "campaigns/campaign.h"
#include "tests/campaigns/campaign_text.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fstream>

namespace tamp::test {

namespace {

namespace fs = std::filesystem;
using Catch::Matchers::Contains;

class Files {
public:
  [[nodiscard]] fs::path write(const std::string& name, std::string_view text) const {
    const fs::path file = folder_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }

private:
  ScratchFolder folder_;
};

std::string refusal(const fs::path& file) {
  try {
    load_campaign(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("a campaign that extends another has the jobs of the two written as one") {
  const Files files;
  (void)files.write("base/test.json", kValid);
  const Plan plan = load_campaign(files.write(
      "over.json", R"({"campaign": "over", "extends": "base/test.json", "replicates": 3, "scene": {"size": 90},
                       "sweep": {"grid": {"scene/psd/sigma_ln": null, "scene/psd/r_max": [20, 30]}}})"));
  const std::string whole = with(with(with(valid_with("\"replicates\": 2", "\"replicates\": 3"), "133", "90"),
                                      R"("scene/psd/sigma_ln": [0.6, 0.68])", R"("scene/psd/r_max": [20, 30])"),
                                 "\"test\"", "\"over\"");
  const Plan same = read_campaign(whole, "c.json");
  CHECK(plan.campaign == "over");
  REQUIRE(plan.jobs.size() == same.jobs.size());
  for (std::size_t i = 0; i < plan.jobs.size(); ++i)
    CHECK(plan.jobs[i].key == same.jobs[i].key);
}

TEST_CASE("campaigns extend through several files; measured sizes lie beside the file that names them") {
  const Files files;
  (void)files.write("far/sizes.csv", "radius\n1\n2\n3\n4\n");
  (void)files.write("far/first.json", R"({"campaign": "first", "methods": ["drop-and-roll"],
    "scene": {"size": 80, "psd": {"law": "histogram", "file": "sizes.csv"}}})");
  (void)files.write("second.json", R"({"campaign": "second", "extends": "far/first.json", "seed": 5})");
  const Plan plan =
      load_campaign(files.write("third.json", R"({"campaign": "third", "extends": "second.json", "replicates": 2})"));
  REQUIRE(plan.jobs.size() == 2);
  CHECK(plan.jobs[0].job.seed == 5);
  CHECK(plan.jobs[0].job.scene.psd.edges.size() > 2);
}

TEST_CASE("mistakes name the file in which they are") {
  const Files files;
  const fs::path base = files.write("base.json", valid_with("\"r_max\": 50", "\"r_max\": -1"));
  const fs::path over = files.write("over.json", R"({"campaign": "over", "extends": "base.json",
    "scene": {"sise": 3}})");
  CHECK_THAT(refusal(over), Contains(over.string() + ":2:15: at /scene/sise: unknown key") &&
                                Contains(base.string() + ":10:16: at /scene/psd/r_max: -1 is out of range"));
  CHECK_THAT(refusal(files.write("nameless.json", R"({"extends": "base.json"})")), Contains("\"campaign\" is missing"));
  CHECK_THAT(refusal(files.write("lost.json", R"({"campaign": "lost", "extends": "nowhere.json"})")),
             Contains("lost.json:1:33: at /extends: there is no file"));
  CHECK_THAT(refusal(files.write("circle.json", R"({"campaign": "circle", "extends": "circle.json"})")),
             Contains("extends itself"));
  (void)files.write("broken.json", "{\n\"campaign\": }");
  CHECK_THAT(refusal(files.write("on-broken.json", R"({"campaign": "b", "extends": "broken.json"})")),
             Contains("broken.json:2:13"));
  CHECK_THAT(refusal(files.write("number.json", R"({"campaign": "n", "extends": 3})")),
             Contains("3 is not the name of a file"));
}

} // namespace tamp::test
