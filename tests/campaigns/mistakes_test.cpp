// What a user is told: every kind of mistake by its place, value, what is allowed and the nearest known word.
#include "campaigns/campaign.h"
#include "tests/campaigns/campaign_text.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>

namespace tamp::test {

namespace {

using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

std::size_t paragraphs(const std::string& message) {
  std::size_t count = message.empty() ? 0 : 1;
  for (std::size_t at = 0; (at = message.find("\n\n", at)) != std::string::npos; at += 2)
    ++count;
  return count;
}

} // namespace

TEST_CASE("the campaign that the mistakes below are made in is valid") {
  REQUIRE(error_of(kValid).empty());
}

TEST_CASE("ten malformed campaigns, each told in full") {
  // syntax
  CHECK(error_of(valid_with("133,", "133")) ==
        "c.json:4:16: at /scene: expected ',' or '}' after the value, found \"psd\" in line 5");
  // unknown key
  CHECK(error_of(valid_with("\"replicates\"", "\"replicate\"")) ==
        "c.json:15:3: at /replicate: unknown key \"replicate\"\n"
        "  allowed: \"$schema\", \"campaign\", \"title\", \"extends\", \"scene\", \"methods\", \"sweep\", "
        "\"replicates\", \"seed\", "
        "\"metrics\", \"budget\", \"timing\", \"report\"\n"
        "  nearest: replicates");
  // wrong type
  CHECK(error_of(valid_with("133", "\"133 um\"")) ==
        "c.json:4:13: at /scene/size: \"133 um\" is a text, not a number or a list of numbers\n"
        "  allowed: a number or a list of numbers, each above 0 (length): Edges of the box, the vertical one last; one "
        "number (or a list of one) means equal edges.");
  // negative size
  CHECK(error_of(valid_with("133", "-133")) ==
        "c.json:4:13: at /scene/size: -133 is out of range\n"
        "  allowed: a number or a list of numbers, each above 0 (length): Edges of the box, the vertical one last; one "
        "number (or a list of one) means equal edges.");
  // empty sweep
  CHECK(error_of(valid_with("[0.6, 0.68]", "[]")) ==
        "c.json:14:44: at /sweep/grid/scene~1psd~1sigma_ln: [] is an empty sweep\n"
        "  allowed: a list of at least one value");
  // r_min > r_max
  CHECK(error_of(valid_with("\"r_min\": 0.1", "\"r_min\": 60")) ==
        "c.json:9:16: at /scene/psd/r_min: \"r_min\" must be smaller than r_max; stated: law = lognormal, mu_ln = 0.3, "
        "r_max = 50, r_min = 60, sigma_ln = 0.6\n"
        "  allowed: smaller than r_max");
  // contradictory moments
  const std::string contradictory =
      error_of(with(valid_with("\"r_min\"", "\"mean\": 1.30, \"sd\": 0.68, \"r_min\""),
                    "  \"sweep\": {\"grid\": {\"scene/psd/sigma_ln\": [0.6, 0.68]}},\n", ""));
  CHECK_THAT(contradictory,
             Contains("c.json:5:12: at /scene/psd: parameters contradict moments: mu_ln 0.3 and sigma_ln "
                      "0.68 go with mean 1.701 and sd 1.304"));
  CHECK_THAT(contradictory,
             Contains("  allowed: parameters and moments that agree within 1 %, or only one of the two"));
  CHECK(paragraphs(contradictory) == 1);
  // unknown method
  CHECK_THAT(error_of(valid_with("\"drop-and-roll\"", "\"drop-and-rol\"")),
             StartsWith("c.json:13:15: at /methods/0: \"drop-and-rol\" is no choice\n"
                        "  allowed: one of \"drop-and-roll\", \"lattice\", ") &&
                 EndsWith(": Which generator makes the packing.\n  nearest: drop-and-roll"));
  // box smaller than the largest sphere
  CHECK(error_of(valid_with("133", "90")) ==
        "c.json:4:13: at /scene/size: \"size\" has the edge 90 um, smaller than the largest sphere (diameter 100 um)\n"
        "  allowed: enlarge the box or lower the largest radius");
  // missing file
  const ScratchFolder folder;
  std::ofstream(folder / "lognormal.json") << kValid;
  std::string missing;
  try {
    load_campaign(folder / "lognromal.json");
  } catch (const InputError& error) {
    missing = error.what();
  }
  CHECK(missing == (folder / "lognromal.json").string() +
                       ": there is no such file\n  nearest: " + (folder / "lognormal.json").string());
  CHECK_THROWS_AS(load_campaign(folder.path()), InputError);
  CHECK(load_campaign(folder / "lognormal.json").jobs.size() == 4);
}

TEST_CASE("all mistakes of a file are told at once, in its order, without echoes") {
  std::string text = valid_with("\"size\": 133", "\"size\": 133, \"sidez\": \"walls\", \"unit\": \"µm\"");
  text = with(text, "\"sigma_ln\": 0.68", "\"sigma\": 0.68"); // no "sigma_ln is missing" on top: the sweep states it
  text = with(text, "\"r_max\": 50", "\"r_max\": \"fifty\""); // no "r_max is missing" on top
  text = with(text, "\"replicates\": 2", "\"replicates\": 0");
  const std::string message = error_of(text);
  INFO(message);
  CHECK(paragraphs(message) == 5);
  CHECK_THAT(message, Contains("at /scene/sidez: unknown key") && Contains("nearest: sides"));
  CHECK_THAT(message, Contains("at /scene/unit: \"µm\" is no choice") && Contains("nearest: um"));
  CHECK_THAT(message, Contains("at /scene/psd/sigma: unknown key") && Contains("nearest: sigma_ln"));
  CHECK_THAT(message, Contains("at /scene/psd/r_max: \"fifty\" is a text, not a number"));
  CHECK_THAT(message, Contains("at /replicates: 0 is out of range\n  allowed: a whole number from 1 to 100000"));
}

TEST_CASE("a misspelt required key is told once") {
  const std::string no_sweep = with(kValid, "  \"sweep\": {\"grid\": {\"scene/psd/sigma_ln\": [0.6, 0.68]}},\n", "");
  CHECK(paragraphs(error_of(with(no_sweep, "\"sigma_ln\"", "\"sigma\""))) == 1);
  CHECK(paragraphs(error_of(with(no_sweep, "\"size\"", "\"sizes\""))) == 1);
  CHECK(paragraphs(error_of(with(no_sweep, "\"lognormal\"", "\"lognormale\""))) == 1);
}

TEST_CASE("required values that are missing") {
  CHECK_THAT(error_of(valid_with("    \"size\": 133,\n", "")),
             Contains("c.json:3:12: at /scene/size: \"size\" is missing"));
  CHECK_THAT(
      error_of(valid_with("      \"mu_ln\": 0.30,\n", "")),
      Contains("c.json:5:12: at /scene/psd/mu_ln: \"mu_ln\" is missing: state mu_ln and sigma_ln, or mean and sd"));
  CHECK_THAT(error_of(valid_with("\"methods\": [\"drop-and-roll\"],", "")), Contains("\"methods\" is missing"));
  CHECK_THAT(error_of(valid_with("\"campaign\": \"test\",", "")), Contains("at /campaign: \"campaign\" is missing"));
  CHECK_THAT(error_of(valid_with("[\"drop-and-roll\"]", "[]")), Contains("the list of methods is empty"));
  CHECK_THAT(error_of(valid_with("\"drop-and-roll\"", "{\"label\": \"x\"}")),
             Contains("at /methods/0/name: \"name\" is missing"));
}

TEST_CASE("values that are no finite numbers, no whole numbers, or stand twice") {
  CHECK_THAT(error_of(valid_with("133", "NaN")), Contains("at /scene/size: NaN is not a finite number"));
  CHECK_THAT(error_of(valid_with("133", "[133, -Infinity, 133]")),
             Contains("at /scene/size/1: -Infinity is not a finite"));
  CHECK_THAT(error_of(valid_with("133", "1e999")), Contains("1e999 is not a finite number"));
  CHECK_THAT(error_of(valid_with("\"replicates\": 2", "\"replicates\": 2.5")), Contains("2.5 is not a whole number"));
  CHECK_THAT(error_of(valid_with("\"size\": 133", "\"size\": 133, \"count\": null")),
             Contains("null where a whole number is due"));
  CHECK_THAT(error_of(valid_with("\"r_min\": 0.1", "\"r_min\": 0.1, \"r_min\": 0.2")),
             Contains("c.json:9:21: at /scene/psd/r_min: the key stands twice in its object"));
  CHECK_THAT(error_of(valid_with("133", "[133, 133]")),
             Contains("\"size\" has 2 numbers\n  allowed: 1 (equal edges) or 3 (the dimension)"));
}

TEST_CASE("unknown names of methods' and metrics' parameters, of metrics and tables") {
  CHECK_THAT(error_of(valid_with("\"drop-and-roll\"", "{\"name\": \"drop-and-roll\", \"max_failure\": 3}")),
             Contains("at /methods/0/max_failure: unknown key") && Contains("nearest: max_failures"));
  CHECK_THAT(error_of(valid_with("\"drop-and-roll\"", "{\"name\": \"lattice\", \"max_failures\": 3}")),
             Contains("\"max_failures\" does not apply to lattice: it counts only when name = drop-and-roll\n"
                      "  allowed: \"name\", \"kind\", \"label\""));
  CHECK_THAT(error_of(valid_with("\"replicates\"", "\"metrics\": [\"helinger\"], \"replicates\"")),
             Contains("at /metrics/0: \"helinger\" is no choice") && Contains("nearest: hellinger"));
  CHECK_THAT(error_of(valid_with("\"replicates\"", "\"metrics\": [\"phi\", {\"name\": \"phi\"}], \"replicates\"")),
             Contains("at /metrics/1: the metric phi stands twice"));
  CHECK_THAT(error_of(valid_with("\"replicates\"", "\"report\": {\"tables\": [\"lognormal-2d\"]}, \"replicates\"")),
             Contains("at /report/tables/0: \"lognormal-2d\" is no table") && Contains("nearest: lognormal_2d"));
  CHECK_THAT(error_of(valid_with("\"replicates\"", "\"budget\": {\"wall\": 3, \"memory_mb\": 0}, \"replicates\"")),
             Contains("at /budget/wall: unknown key") && Contains("nearest: wall_s") &&
                 Contains("/budget/memory_mb: 0 is out"));
  CHECK_THAT(error_of(valid_with("\"replicates\"", "\"timing\": \"alone\", \"replicates\"")),
             Contains("\"exclusive\""));
  CHECK_THAT(error_of(valid_with("\"test\"", "\"a/b\"")), Contains("at /campaign: \"a/b\" is no name"));
  CHECK_THAT(
      error_of(valid_with("[\"drop-and-roll\"]", "[\"drop-and-roll\", {\"name\": \"drop-and-roll\", \"lid\": false}]")),
      Contains("at /methods/1: two methods have the label \"drop-and-roll\""));
  CHECK_THAT(error_of(valid_with("[\"drop-and-roll\"]",
                                 R"(["drop-and-roll", {"name": "lattice", "label": "L", "from": "drop-and-roll"}])")),
             Contains("at /methods/1/from: lattice does not start from a packing\n  allowed: no \"from\""));
}

TEST_CASE("values that count nowhere, for the law or the method") {
  CHECK_THAT(error_of(valid_with("\"r_min\"", "\"shape\": 2, \"r_min\"")),
             Contains("at /scene/psd/shape: \"shape\" counts nowhere here\n  allowed: only where psd/law = weibull"));
  CHECK_THAT(error_of(valid_with("\"scene/psd/sigma_ln\": [0.6, 0.68]", "\"method/kind\": [\"fcc\"]")),
             Contains("at /sweep/grid/method~1kind: \"method/kind\" fits none of the methods (drop-and-roll)\n"
                      "  allowed: only where name = lattice"));
}

TEST_CASE("sweeps that do not make sense") {
  const auto swept = [](const std::string& sweep) {
    return error_of(valid_with("{\"grid\": {\"scene/psd/sigma_ln\": [0.6, 0.68]}}", sweep));
  };
  CHECK(swept(R"({"zip": {"scene/size": [133, 150], "replicates": [1, 2, 3]}})") ==
        "c.json:14:20: at /sweep/zip: the lists of a zip differ in length: scene/size has 2, replicates has 3\n"
        "  allowed: lists of equal length");
  CHECK_THAT(swept(R"({"grid": {"scene/siz": [133]}})"),
             Contains("at /sweep/grid/scene~1siz: unknown parameter path \"scene/siz\"") &&
                 Contains("nearest: scene/size"));
  CHECK_THAT(swept(R"({"grid": {"size_ratio": [1]}})"), Contains("nearest: scene/psd/size_ratio"));
  CHECK_THAT(swept(R"({"grid": {"method/name": ["lattice"]}})"),
             Contains("list the methods to compare under \"methods\""));
  CHECK_THAT(swept(R"({"grid": {"scene/size": [133]}, "zip": {"scene/size": [150]}})"),
             Contains("is swept twice in one block"));
  CHECK_THAT(swept(R"({"grid": {"scene/size": 133}})"),
             Contains("at /sweep/grid/scene~1size: 133 is not a list of values"));
  CHECK_THAT(swept("[]"), Contains("at /sweep: [] is an empty sweep"));
  CHECK_THAT(swept(R"({"points": []})"), Contains("at /sweep/points: [] is an empty sweep"));
  CHECK_THAT(swept("{}"), Contains("at /sweep: the block is empty"));
  CHECK_THAT(swept(R"([{"gird": {}}])"), Contains("at /sweep/0/gird: unknown key") && Contains("nearest: grid"));
  CHECK_THAT(swept(R"({"grid": {"seed": [1, 2, 3], "replicates": [100000]}})"),
             Contains("expands into more than 100000 jobs"));
}

TEST_CASE("a value that a sweep makes wrong is told at the sweep, with the point") {
  const auto swept = [](const std::string& sweep) {
    return error_of(valid_with("{\"grid\": {\"scene/psd/sigma_ln\": [0.6, 0.68]}}", sweep));
  };
  CHECK(swept(R"({"grid": {"scene/size": [133, -4]}})") ==
        "c.json:14:42: at /sweep/grid/scene~1size/1: -4 is out of range\n"
        "  allowed: a number or a list of numbers, each above 0 (length): Edges of the box, the vertical one last; one "
        "number (or a list of one) means equal edges.");
  // told once, although two seeds meet the size
  CHECK(swept(R"({"grid": {"seed": [1, 2], "scene/size": [133, 90]}})") ==
        "c.json:14:58: at /sweep/grid/scene~1size/1: \"size\" has the edge 90 um, smaller than the largest sphere "
        "(diameter 100 um) (at the point seed = 1, scene/size = 90)\n"
        "  allowed: enlarge the box or lower the largest radius");
  // the size is the base scene's, but the sweep makes it wrong
  CHECK_THAT(swept(R"({"grid": {"scene/psd/r_max": [50, 70]}})"),
             Contains("at /sweep/grid/scene~1psd~1r_max/1: \"size\" has the edge 133 um") &&
                 Contains("(at the point scene/psd/r_max = 70)"));
  CHECK_THAT(swept(R"({"points": [{"scene/size": 200}, {"scene/psd/r_max": 70, "seed": 2}]})"),
             Contains("at /sweep/points/1: \"size\" has the edge 133 um"));
  // a law that lacks its parameters at one point
  CHECK_THAT(
      swept(R"({"points": [{"seed": 2}, {"scene/psd/law": "monodisperse"}]})"),
      Contains("at /sweep/points/1: \"radius\" is missing: the law monodisperse needs it (at the point scene/psd/law"));
}

} // namespace tamp::test
