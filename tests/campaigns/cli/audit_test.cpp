// tamp audit through the real command: what it finds in sound and in spoilt packings, and how it refuses bad files.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

using namespace tamp::test;
using Catch::Contains;
using nlohmann::json;

namespace {

constexpr const char* kLaw = "lognormal,mu_ln=0.3,sigma_ln=0.3,r_min=0.5,r_max=4,unit=um";

/// A workshop with a packing of some hundred spheres, its record, and its dump.
struct Bed {
  Workshop shop{TAMP_BINARY};
  json record;

  Bed() {
    shop.write("bed.json", R"({"campaign": "bed", "scene": {"unit": "um", "size": 18, "psd": {"law": "lognormal",
      "mu_ln": 0.3, "sigma_ln": 0.3, "r_min": 0.5, "r_max": 4}}, "methods": ["drop-and-roll"]})");
    REQUIRE(shop.tamp("run bed.json").code == 0);
    record = shop.results("tamp-store").begin()->second;
    REQUIRE(shop.tamp("export " + record.at("key").get<std::string>() + " --out bed.dump").code == 0);
  }

  std::string dump() const { return tamp::read_file(shop.folder() / "bed.dump"); }

  json audit(const std::string& arguments) const {
    const Said said = shop.tamp("audit --format json " + arguments);
    INFO(said.err);
    REQUIRE(said.code == 0);
    return json::parse(said.out).at("audits").at(0);
  }
};

/// The dump's lines of atoms, and what stands above them.
std::pair<std::string, std::vector<std::string>> split(const std::string& dump) {
  std::size_t at = dump.find('\n', dump.find("ITEM: ATOMS")) + 1;
  std::pair<std::string, std::vector<std::string>> parts{dump.substr(0, at), {}};
  for (std::size_t end = 0; at < dump.size(); at = end + 1) {
    end = dump.find('\n', at);
    parts.second.push_back(dump.substr(at, end - at));
  }
  return parts;
}

} // namespace

TEST_CASE("an audit of an exported packing finds what the record says") {
  const Bed bed;
  for (const std::string law : {"--campaign bed.json", kLaw}) {
    const json found = bed.audit("bed.dump " + (law == kLaw ? "--law " + law : law));
    const auto& measures = bed.record.at("measures");
    for (const char* name : {"phi", "phi_paper", "H_N", "H_V", "H_V_floor", "z", "overlap_max", "stable_alone"})
      CHECK(found.at("measures").at(name).at("value") == measures.at(name).at("value"));
    CHECK(found.at("law").at("fitted") == false);
    CHECK(found.at("floating").at("count") == 0);
    CHECK(found.at("worst_overlaps").empty());
  }
  const json fitted = bed.audit("bed.dump");
  CHECK(fitted.at("law").at("fitted") == true);
  CHECK(fitted.at("measures").at("phi").at("value") == bed.record.at("measures").at("phi").at("value"));
}

TEST_CASE("an audit finds a planted overlap and a floating sphere") {
  const Bed bed;
  auto [head, atoms] = split(bed.dump());
  // Far above the bed: two that overlap, and one alone.
  const std::size_t n = atoms.size();
  head.replace(head.find(fmt::format("\n{}\n", n)), fmt::format("\n{}\n", n).size(), fmt::format("\n{}\n", n + 3));
  head.replace(head.find("ff ff ff"), 8, "ff ff fs");
  std::string text = head;
  for (const std::string& line : atoms)
    text += line + "\n";
  text += "9001 1 5 5 40 1\n9002 1 5 5 41.5 2\n9003 1 12 12 40 1\n";
  bed.shop.write("planted.dump", text);
  const json found = bed.audit("planted.dump --as-it-is --law " + std::string(kLaw));
  REQUIRE(found.at("worst_overlaps").size() == 1);
  CHECK(found.at("worst_overlaps").at(0).at("sphere") == 9001);
  CHECK(found.at("worst_overlaps").at(0).at("other") == 9002);
  CHECK(found.at("worst_overlaps").at(0).at("depth").get<double>() == Approx(1.5));
  CHECK(found.at("floating") == json({{"count", 1}, {"first", {9003}}}));
  const Said said = bed.shop.tamp("audit planted.dump bed.dump");
  CHECK(said.code == 0);
  CHECK_THAT(said.out, Contains("spheres 9001 and 9002") && Contains("1 spheres touch nothing: 9003"));
  CHECK_THAT(said.out, Contains("planted.dump  bed.dump")); // the table
}

TEST_CASE("an audit asks about sizes a thousand times off") {
  const Bed bed;
  REQUIRE(bed.shop.tamp("export bed.dump --out bed.csv").code == 0);
  std::string text = tamp::read_file(bed.shop.folder() / "bed.csv");
  for (std::size_t at = text.find("um"); at != std::string::npos; at = text.find("um", at))
    text.replace(at, 2, "mm");
  bed.shop.write("shifted.csv", text);
  const std::string law = std::string(" --law ") + kLaw;
  const Said said = bed.shop.tamp("audit shifted.csv" + law);
  CHECK(said.code == 2);
  CHECK_THAT(said.err, Contains("shifted.csv") && Contains("1e3 times") && Contains("--unit um"));
  CHECK(bed.shop.tamp("audit shifted.csv --as-it-is" + law).code == 0);
  const json mended = bed.audit("shifted.csv --unit um" + law);
  CHECK(mended.at("measures").at("phi").at("value") == bed.record.at("measures").at("phi").at("value"));
}

TEST_CASE("an audit in another unit than the law's finds the same") {
  const Bed bed;
  const json in_nm =
      bed.audit("bed.dump --law lognormal,mu_ln=7.207755278982137,sigma_ln=0.3,r_min=500,r_max=4000,unit=nm");
  const auto& measures = bed.record.at("measures");
  CHECK(in_nm.at("unit") == "nm");
  for (const char* name : {"phi", "H_N"})
    CHECK(in_nm.at("measures").at(name).at("value").get<double>() ==
          Approx(measures.at(name).at("value").get<double>()).epsilon(1e-9));
}

TEST_CASE("bad files and bad words end an audit with code 2, the line and the reason") {
  const Workshop shop(TAMP_BINARY);
  shop.write("good.csv", "x,y,z,r\n1,1,1,1\n4,4,4,1\n");
  const auto refused = [&](const std::string& text, const std::string& arguments, const std::string& message) {
    shop.write("p.csv", text);
    const Said said = shop.tamp("audit p.csv " + arguments);
    CAPTURE(text, arguments, said.err);
    CHECK(said.code == 2);
    CHECK(said.out.empty());
    CHECK_THAT(said.err, Contains(message));
  };
  refused("x,y,z,r\n1,1,1,1\n1,1\n", "", "p.csv:3: 2 columns");
  refused("x,y,z,r\n1,1,1,nan\n", "", "p.csv:2: sphere 1 has the radius nan");
  refused("x,y,z,r\n1,1,1,-1\n", "", "p.csv:2: sphere 1 has the radius -1");
  refused("x,y,z,r\n1,1,1,1\n1,1,9,1\n", "--box 5,5,5", "p.csv:3: sphere 2 at z = 9 lies beyond the wall at 5");
  refused("id,x,y,z,r\n1,1,1,1,1\n1,3,3,3,1\n", "", "p.csv:3: sphere 1 stood already in line 2");
  refused("# count 9\nx,y,z,r\n1,1,1,1\n", "", "says that it has 9");
  const std::string good = "x,y,z,r\n1,1,1,1\n4,4,4,1\n";
  refused(good, "--law cubes", "allowed: monodisperse, lognormal");
  refused(good, "--law lognormal,mu=1", "unknown parameter \"mu\"");
  refused(good, "--law lognormal,sigma_ln=-1", "allowed: ");
  refused(good, "--law monodisperse", "radius");
  refused(good, "--law monodisperse,radius=1 --campaign c.json", "give one");
  refused(good, "--campaign absent.json", "absent.json");
  refused(good, "absent.csv", "there is no file absent.csv");
}

TEST_CASE("packings that some metric cannot judge are audited by the others") {
  const Workshop shop(TAMP_BINARY);
  shop.write("one.csv", "x,y,z,r\n1,1,1,1\n");
  shop.write("flat.csv", "x,y,r\n1,1,1\n3,1,1\n5,1,1\n");
  const Said said = shop.tamp("audit one.csv flat.csv");
  INFO(said.err);
  CHECK(said.code == 0);
  CHECK_THAT(said.out, Contains("not measured: ") && Contains("3 spheres in 2D"));
}
