// Damaged campaign files never crash the reader: each gives a plan or an InputError that names the file.
#include "campaigns/campaign.h"
#include "engine/base/files.h"
#include "engine/base/random.h"
#include "tests/campaigns/campaign_text.h"

#include <catch2/catch.hpp>

namespace tamp::test {

namespace {

/// One random change: a byte, a stretch that is lost or repeated, or a word of another place.
void damage(std::string& text, RandomStream& random) {
  static const std::vector<std::string> words = {"null",
                                                 "NaN",
                                                 "1e999",
                                                 "-1",
                                                 "0",
                                                 "[]",
                                                 "{}",
                                                 "\"\"",
                                                 "1e-320",
                                                 "1e308",
                                                 "99999999999999999999",
                                                 "\"histogram\"",
                                                 "\"bimodal\"",
                                                 "\"weibull\"",
                                                 "\"normal\"",
                                                 "\"monodisperse\"",
                                                 "[1,2,3]",
                                                 "\"m\"",
                                                 "2",
                                                 "true",
                                                 "\"scene/psd/law\"",
                                                 "\"scene/unit\"",
                                                 "\"file\"",
                                                 "\"weighting\"",
                                                 "//",
                                                 "/*",
                                                 "\\u0000",
                                                 "\xF0\x9F\x98\x80"};
  if (text.empty())
    return;
  const std::size_t at = random.below(text.size());
  const std::size_t length = 1 + random.below(20);
  switch (random.below(5)) {
  case 0:
    text[at] = static_cast<char>(random.below(256));
    break;
  case 1:
    text.erase(at, length);
    break;
  case 2:
    text.insert(random.below(text.size()), text.substr(at, length));
    break;
  case 3:
    text.insert(at, words[random.below(words.size())]);
    break;
  default: { // a whole value replaced
    const std::size_t begin = text.find_first_of("0123456789\"", at);
    if (begin == std::string::npos)
      return;
    const std::size_t end = std::min(text.find_first_of(",]}\n", begin), text.size());
    text.replace(begin, end - begin, words[random.below(words.size())]);
  }
  }
}

} // namespace

TEST_CASE("damaged campaigns give a plan or an InputError") {
  const std::filesystem::path folder = std::filesystem::path(TAMP_SOURCE_DIR) / "campaigns";
  std::vector<std::string> sources = {kValid};
  for (const char* name : {"lognormal-2d.json", "quickstart.json", "lattices.json"})
    sources.push_back(read_file(folder / name));
  sources.emplace_back(R"({"campaign": "laws", "methods": ["drop-and-roll", {"name": "lattice", "kind": "sc"}],
    "scene": {"size": [90, 80, 70], "psd": {"law": "weibull", "scale": 2, "shape": 1.5, "weighting": "volume", "r_min": 1,
    "r_max": 9}}, "sweep": [{"points": [{"scene/psd/law": "histogram", "scene/psd/edges": [1, 2, 3], "scene/psd/weights":
    [4, 5]}, {"scene/psd/law": "bimodal", "scene/psd/small_radius": 1, "scene/psd/size_ratio": 5,
    "scene/psd/large_volume_fraction": 0.7}], "grid": {"method/lid": [true, false]}}, {"zip": {"scene/count": [1, 2],
    "scene/psd/scale": [2, 3]}}], "replicates": 2})");
  sources.emplace_back(R"({"campaign": "parts", "methods": ["drop-and-roll", {"name": "lattice", "kind": "sc"}],
    "scene": {"size": 90, "psd": {"law": "monodisperse", "radius": 2}},
    "sweep": {"grid": {"scene/psd/radius": [1, 2, 3]}, "derived": {"scene/size": "cbrt(90^3) + (2*scene.psd.radius)/pi"},
    "exclude": [{"scene/psd/radius": [2], "method": "lattice"}], "include": [{"scene/psd/radius": 4}],
    "when": {"method": ["lattice", "drop-and-roll"], "scene/unit": "um"}}})");
  RandomStream random("fuzz", 0);
  int plans = 0;
  int errors = 0;
  for (int i = 0; i < 6000; ++i) {
    std::string text = sources[random.below(sources.size())];
    for (std::uint64_t n = 1 + random.below(3); n > 0; --n)
      damage(text, random);
    INFO(text);
    try {
      const Plan plan = read_campaign(text, "damaged.json");
      REQUIRE_FALSE(plan.jobs.empty());
      ++plans;
    } catch (const InputError& error) {
      REQUIRE(std::string(error.what()).rfind("damaged.json:", 0) == 0);
      ++errors;
    }
  }
  CHECK(plans > 300); // the damage is not so great that it only tests the parser
  CHECK(errors > 1000);
}

} // namespace tamp::test
