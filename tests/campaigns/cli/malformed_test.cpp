// Ten malformed campaigns: ten clear errors, exit code 2, nothing written.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace tamp::test;
using Catch::Contains;

namespace {

struct Malformed {
  std::string what;
  std::string text; ///< empty: there is no such file
  std::string word; ///< that the message must have
};

/// A sound campaign with its scene, its size law, its methods and more replaced.
std::string campaign(const std::string& scene, const std::string& psd, const std::string& methods,
                     const std::string& more = "") {
  return fmt::format(R"({{
  "campaign": "c",
  "scene": {{"dimension": 2, {}, "psd": {{{}}}}},
  "methods": [{}]{}
}})",
                     scene, psd, methods, more);
}

const std::string kSize = R"("size": 60)";
const std::string kLaw = R"("law": "lognormal", "mu_ln": 0.3, "sigma_ln": 0.68, "r_min": 0.1, "r_max": 20)";
const std::string kMethod = R"("drop-and-roll")";

std::vector<Malformed> malformed() {
  return {
      {"syntax", R"({"campaign": "c", "scene": {)", "bad.json:1"},
      {"unknown key", campaign(R"("sise": 60)", kLaw, kMethod), "size"},
      {"wrong type", campaign(R"("size": "large")", kLaw, kMethod), "large"},
      {"negative size", campaign(R"("size": -60)", kLaw, kMethod), "-60"},
      {"empty sweep", campaign(kSize, kLaw, kMethod, R"(, "sweep": {"grid": {"scene/size": []}})"), "sweep"},
      {"r_min > r_max",
       campaign(kSize, R"("law": "lognormal", "mu_ln": 0.3, "sigma_ln": 0.68, "r_min": 20, "r_max": 0.1)", kMethod),
       "r_min"},
      {"contradictory moments", campaign(kSize, kLaw + R"(, "mean": 1.3, "sd": 0.68)", kMethod), "mean"},
      {"unknown method", campaign(kSize, kLaw, R"("drop-and-rol")"), "drop-and-roll"},
      {"box smaller than the largest sphere", campaign(R"("size": 30)", kLaw, kMethod), "sphere"},
      {"missing file", "", "bad.json"},
  };
}

} // namespace

TEST_CASE("malformed campaigns end with code 2 before anything is written") {
  for (const Malformed& bad : malformed()) {
    const Workshop shop(TAMP_BINARY);
    if (!bad.text.empty())
      shop.write("bad.json", bad.text);
    const auto before = digests(shop.folder());
    for (const char* command : {"run", "plan"}) {
      const Said said = shop.tamp(std::string(command) + " bad.json");
      CAPTURE(bad.what, command, said.err);
      CHECK(said.code == 2);
      CHECK(said.err.starts_with("tamp: error: "));
      CHECK_THAT(said.err, Contains("bad.json") && Contains(bad.word));
      CHECK(said.out.empty());
    }
    CHECK(digests(shop.folder()) == before);
    CHECK_FALSE(fs::exists(shop.folder() / "tamp-store"));
  }
}

TEST_CASE("the campaign from which the malformed ones are made is sound") {
  const Workshop shop(TAMP_BINARY);
  shop.write("good.json", campaign(kSize, kLaw, kMethod));
  const Said said = shop.tamp("plan good.json");
  CAPTURE(said.err);
  CHECK(said.code == 0);
}

TEST_CASE("one malformed campaign among sound ones stops all, and all mistakes are shown") {
  const Workshop shop(TAMP_BINARY);
  shop.write("good.json", disc_campaign(20, 1));
  shop.write("bad.json", campaign(R"("size": -60)", kLaw, kMethod));
  const Said said = shop.tamp("run good.json bad.json absent.json");
  CHECK(said.code == 2);
  CHECK_THAT(said.err, Contains("bad.json") && Contains("absent.json"));
  CHECK_FALSE(fs::exists(shop.folder() / "tamp-store"));
}
