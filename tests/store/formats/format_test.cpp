// Every row of the table of formats: packings come back as they went, damaged files are refused and crash nothing.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/random.h"
#include "store/formats/format.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/engine/model/some_packing.h"
#include "tests/store/formats/damage.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <set>

using namespace tamp;
using Catch::Matchers::Contains;

namespace {

std::string first_ending(const Format& format) {
  return std::string(format.endings.substr(0, format.endings.find(' ')));
}

} // namespace

TEST_CASE("a packing comes back from every format as it went") {
  const ScratchFolder folder;
  for (const Format& format : formats()) {
    if (format.write == nullptr || format.read == nullptr)
      continue;
    const std::filesystem::path path = folder / ("p" + first_ending(format));
    for (const int dimension : {2, 3}) {
      for (const LengthUnit unit : {LengthUnit::nm, LengthUnit::mm}) {
        CAPTURE(format.name, dimension, name_of(unit));
        Packing packing = test::some_packing(dimension, 300);
        packing.unit = unit;
        format.write(path, packing, {});
        CHECK(&format_of_file(path) == &format);
        Surroundings stated;
        if (format.name == "mercury") { // whose files have no unit and no sides
          stated.unit = unit;
          std::copy(packing.boundary.begin(), packing.boundary.end(), stated.boundary.begin());
        }
        const ReadPacking read = read_foreign(path, stated);
        test::check_same(read.packing, packing);
        CHECK(read.said.unit == unit);
        const std::string bytes = read_file(path);
        format.write(path, packing, {});
        CHECK((read_file(path) == bytes)); // the same packing, the same bytes
      }
    }
  }
}

TEST_CASE("names and endings of formats are their own") {
  std::set<std::string_view> names;
  std::set<std::string> endings;
  for (const Format& format : formats()) {
    CHECK(names.insert(format.name).second);
    CHECK(endings.insert(first_ending(format)).second);
    CHECK_FALSE(format.summary.empty());
    CHECK(&format_named(format.name) == &format);
  }
  CHECK_THROWS_WITH(format_named("gif"), Contains("allowed: h5, csv"));
  CHECK_THROWS_WITH(format_of_file("packing.gif"), Contains("known are h5, csv"));
  CHECK_THROWS_AS(read_foreign("absent.csv"), InputError);
}

TEST_CASE("damaged files of every format give a sound packing or an InputError that names the file") {
  const ScratchFolder folder;
  RandomStream random("fuzz formats", 0);
  for (const Format& format : formats()) {
    if (format.write == nullptr || format.read == nullptr)
      continue;
    const std::filesystem::path path = folder / ("p" + first_ending(format));
    std::vector<std::string> sources;
    for (const int dimension : {2, 3}) {
      format.write(path, test::some_packing(dimension, 12), {});
      sources.push_back(read_file(path));
    }
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
      std::string bytes = sources[random.below(2)];
      for (std::uint64_t n = 1 + random.below(3); n > 0; --n)
        test::damage(bytes, random);
      std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
      try {
        const Packing packing = format.read(path, {}).packing;
        REQUIRE(packing.count() > 0);
        REQUIRE(packing.positions.size() == packing.count() * static_cast<std::size_t>(packing.dimension));
        for (const double r : packing.radii)
          REQUIRE((std::isfinite(r) && r > 0));
        for (const double x : packing.positions)
          REQUIRE(std::isfinite(x));
        ++read;
      } catch (const InputError& e) {
        REQUIRE(std::string(e.what()).find(path.string()) != std::string::npos);
        ++refused;
      }
    }
    CAPTURE(format.name);
    CHECK(read > 15); // the damage is not so great that it only tests the first check
    CHECK(refused > 100);
  }
}
