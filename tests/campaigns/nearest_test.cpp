// The edit distance against its recursive definition, and the words it finds.
#include "campaigns/nearest.h"
#include "engine/base/random.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

namespace tamp::test {

namespace {

/// The definition of the optimal string alignment distance, without tables.
std::size_t by_definition(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty())
    return a.size() + b.size();
  const std::string_view a1 = a.substr(1);
  const std::string_view b1 = b.substr(1);
  std::size_t best =
      std::min({by_definition(a1, b) + 1, by_definition(a, b1) + 1, by_definition(a1, b1) + (a[0] == b[0] ? 0 : 1)});
  if (a.size() > 1 && b.size() > 1 && a[0] == b[1] && a[1] == b[0])
    best = std::min(best, by_definition(a.substr(2), b.substr(2)) + 1);
  return best;
}

} // namespace

TEST_CASE("the edit distance equals its definition") {
  RandomStream random("edit", 0);
  const auto word = [&] {
    std::string out;
    for (std::uint64_t i = random.below(7); i > 0; --i)
      out += static_cast<char>('a' + random.below(3));
    return out;
  };
  for (int i = 0; i < 500; ++i) {
    const std::string a = word();
    const std::string b = word();
    INFO(a << " " << b);
    REQUIRE(edit_distance(a, b) == by_definition(a, b));
  }
  CHECK(edit_distance("Drop_and-Roll", "drop-and-roll") == 0);
}

TEST_CASE("the nearest word is found, and none where none is near") {
  const std::vector<std::string> keys = {"size", "sides", "sigma_ln", "max_failures", "psd/r_min"};
  CHECK(nearest("siez", keys) == "size");
  CHECK(nearest("sigma", keys) == "sigma_ln");
  CHECK(nearest("MAX-FAILURE", keys) == "max_failures");
  CHECK(nearest("r_min", keys) == "psd/r_min");
  CHECK(nearest("temperature", keys).empty());
  CHECK(nearest("", keys).empty());
  CHECK(nearest(std::string(5000, 's'), keys).empty());
}

} // namespace tamp::test
