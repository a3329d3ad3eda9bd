// What conditions leave out of a sweep, what is added, and values that follow from others.
#include "campaigns/campaign.h"
#include "tests/campaigns/campaign_text.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

namespace tamp::test {

namespace {

std::string text_of(const std::string& sweep, const std::string& methods) {
  return with(with(R"({"campaign": "c", "scene": {"size": 100, "psd": {"law": "monodisperse", "radius": 1}},
  "methods": METHODS,
  "sweep": SWEEP})",
                   "SWEEP", sweep),
              "METHODS", methods);
}

const std::string kTwo = R"([{"name": "drop-and-roll", "label": "D&R"}, {"name": "lattice", "kind": "fcc"}])";

/// "D&R 20/1" for each job: label, edge and radius.
std::vector<std::string> made(const std::string& sweep, const std::string& methods = R"(["drop-and-roll"])") {
  std::vector<std::string> out;
  for (const PlannedJob& job : read_campaign(text_of(sweep, methods), "c.json").jobs)
    out.push_back(fmt::format("{} {}/{}", job.label, job.job.scene.size.at(0), job.job.scene.psd.radius));
  return out;
}

std::string refusal(const std::string& sweep, const std::string& methods = R"(["drop-and-roll"])") {
  return error_of(text_of(sweep, methods));
}

using Lines = std::vector<std::string>;
using Catch::Matchers::Contains;

} // namespace

TEST_CASE("excluded points are not made, nor told of when they are impossible") {
  CHECK(made(R"({"grid": {"scene/size": [20, 40], "scene/psd/radius": [1, 2]},
                 "exclude": [{"scene/size": 20, "scene/psd/radius": [2, 3]}]})") ==
        Lines{"drop-and-roll 20/1", "drop-and-roll 40/1", "drop-and-roll 40/2"});
  CHECK_THAT(refusal(R"({"grid": {"scene/size": [20, 40], "scene/psd/radius": [1, 15]}})"), Contains("\"size\""));
  CHECK(made(R"({"grid": {"scene/size": [20, 40], "scene/psd/radius": [1, 15]},
                 "exclude": [{"scene/psd/radius": 15}]})")
            .size() == 2);
}

TEST_CASE("conditions can name methods, by label or name, and their parameters") {
  CHECK(made(R"({"grid": {"scene/size": [20, 40]}, "exclude": [{"method": "lattice", "scene/size": 40}]})", kTwo) ==
        Lines{"D&R 20/1", "lattice 20/1", "D&R 40/1"});
  CHECK(made(R"([{"grid": {"scene/size": [20]}}, {"when": {"method": "D&R"}, "grid": {"scene/size": [40]}}])", kTwo) ==
        Lines{"D&R 20/1", "lattice 20/1", "D&R 40/1"});
  CHECK(made(R"({"grid": {"scene/size": [20]}, "when": {"method/kind": ["fcc", "sc"]}})", kTwo) ==
        Lines{"lattice 20/1"});
}

TEST_CASE("what a kept method starts from is kept; what starts from an excluded one is excluded") {
  const std::string chain =
      R"(["drop-and-roll", {"name": "dem-isostatic", "label": "dense", "from": "drop-and-roll"}])";
  CHECK(made(R"({"grid": {"scene/size": [20]}, "when": {"method": "dense"}})", chain) ==
        Lines{"drop-and-roll 20/1", "dense 20/1"});
  CHECK(made(R"({"grid": {"scene/size": [20, 40]}, "exclude": [{"method": "drop-and-roll", "scene/size": 20}]})",
             chain) == Lines{"drop-and-roll 40/1", "dense 40/1"});
}

TEST_CASE("included points come last and are not excluded") {
  CHECK(made(R"({"include": [{"scene/size": 60, "scene/psd/radius": 3}], "grid": {"scene/size": [20, 40]},
                 "exclude": [{"scene/size": [20, 60]}]})") == Lines{"drop-and-roll 40/1", "drop-and-roll 60/3"});
  CHECK(made(R"({"include": [{"scene/size": 60}, {"scene/size": 50}]})") ==
        Lines{"drop-and-roll 60/1", "drop-and-roll 50/1"});
}

TEST_CASE("derived values follow from others, stated, swept or derived before, and have the same key as written ones") {
  CHECK(made(R"({"grid": {"scene/psd/radius": [1, 2]},
                 "derived": {"scene/size": "20 * scene.psd.radius", "scene/count": "scene.size / 2 + seed"}})") ==
        Lines{"drop-and-roll 20/1", "drop-and-roll 40/2"});
  const auto key = [](const std::string& sweep) {
    return read_campaign(text_of(sweep, R"(["drop-and-roll"])"), "c.json").jobs.at(0).key;
  };
  CHECK(key(R"({"derived": {"scene/size": "cbrt(1000) * 3"}})") == key(R"({"grid": {"scene/size": [30]}})"));
  CHECK(key(R"({"derived": {"scene/size": "log(2) * 10"}})") == key(R"({"grid": {"scene/size": [6.9314718056]}})"));
}

TEST_CASE("mistakes of conditions and expressions are told in their place") {
  CHECK_THAT(refusal(R"({"derived": {"scene/size": "20 * scene.psd.radus"}})"),
             Contains("c.json:3:45: at /sweep/derived/scene~1size: \"scene.psd.radus\" is no number") &&
                 Contains("nearest: scene.psd.radius"));
  CHECK_THAT(refusal(R"({"derived": {"scene/size": "20 * (1"}})"), Contains("expected ')', found the end"));
  CHECK_THAT(refusal(R"({"derived": {"scene/size": "1 / 0"}})"), Contains("the expression gives inf"));
  CHECK_THAT(refusal(R"({"derived": {"seed": "1.5"}})"), Contains("the expression gives 1.5"));
  CHECK_THAT(refusal(R"({"derived": {"scene/size": "method.max_failures"}})"),
             Contains("method.max_failures has no value"));
  CHECK_THAT(refusal(R"({"derived": {"scene/psd/law": "1"}})"), Contains("is no number"));
  CHECK_THAT(refusal(R"({"grid": {"scene/size": [20]}, "derived": {"scene/size": "1"}})"), Contains("swept twice"));
  CHECK_THAT(refusal(R"({"grid": {"scene/size": [20]}, "exclude": [{"scene/size": 30}]})"),
             Contains("/sweep/exclude/0: the condition holds nowhere"));
  CHECK_THAT(refusal(R"({"grid": {"scene/size": [20]}, "exclude": [{"scene/size": 20}]})"), Contains("leave nothing"));
  CHECK_THAT(refusal(R"({"grid": {"scene/size": [20]}, "when": {"method": "drop-and-rol"}})"),
             Contains("nearest: drop-and-roll"));
}

} // namespace tamp::test
