// The campaign lammps-quick through the real command: LAMMPS and the native engine bring the same bed.
#include "tests/campaigns/cli/tamp_command.h"

#include <catch2/catch.hpp>

#include <array>
#include <sstream>
#include <vector>

using namespace tamp::test;
using Catch::Contains;

namespace {

/// Two beds of two thousand spheres from the same places: settled in other ways, they differ by some 0.01 in phi.
constexpr double kSamePhi = 0.01;
/// Their last stages differ in stiffness, hence in overlap and in contacts that hardly touch.
constexpr double kSameContacts = 0.5;
/// LAMMPS prints the edges of a box with one digit less than doubles have.
constexpr double kDumpDigits = 1e-9;

/// A text dump with columns id x y z radius, as LAMMPS wrote it.
struct Dump {
  std::vector<std::string> bounds; ///< the line that names the sides, and one an axis
  std::vector<std::array<double, 5>> atoms;

  explicit Dump(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    const auto find = [&](const char* item) {
      while (!line.starts_with(item))
        REQUIRE(std::getline(lines, line));
    };
    find("ITEM: BOX BOUNDS");
    for (bounds = {line}; bounds.size() < 4; bounds.push_back(line))
      std::getline(lines, line);
    find("ITEM: ATOMS id x y z radius");
    for (std::array<double, 5> a{}; lines >> a[0] >> a[1] >> a[2] >> a[3] >> a[4];)
      atoms.push_back(a);
  }

  /// With all lengths multiplied by `scale`.
  [[nodiscard]] std::string text(double scale = 1) const {
    std::string out = fmt::format("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\n{}\n", atoms.size(), bounds[0]);
    for (std::size_t a = 1; a < bounds.size(); ++a) {
      std::istringstream edges(bounds[a]);
      double low = 0;
      double high = 0;
      edges >> low >> high;
      out += fmt::format("{:.17g} {:.17g}\n", scale * low, scale * high);
    }
    out += "ITEM: ATOMS id x y z radius\n";
    for (const auto& a : atoms)
      out += fmt::format("{:.0f} {:.17g} {:.17g} {:.17g} {:.17g}\n", a[0], scale * a[1], scale * a[2], scale * a[3],
                         scale * a[4]);
    return out;
  }
};

} // namespace

TEST_CASE("lammps-quick: every radius drawn is in the packing, and LAMMPS's bed is the native one's", "[slow]") {
  const Workshop shop(TAMP_BINARY);
  fs::copy_file(fs::path(TAMP_SOURCE_DIR) / "campaigns" / "lammps-quick.json", shop.folder() / "quick.json");
  fs::copy_file(fs::path(TAMP_SOURCE_DIR) / "campaigns" / "schema.json", shop.folder() / "schema.json");
  const Said said = shop.tamp("run quick.json --cores 1");
  CAPTURE(said.out, said.err);
  nlohmann::json theirs;
  nlohmann::json ours;
  for (const auto& [key, row] : shop.results("tamp-store"))
    if (row.at("method") != "drop-and-roll")
      (row.at("method") == "lammps-gravity" ? theirs : ours) = row;
  REQUIRE(theirs.is_object());
  if (theirs.at("outcome") == "not-applicable") {
    WARN("skipped: " << theirs.at("reason"));
    return;
  }
  REQUIRE(theirs.at("outcome") == "ok");
  REQUIRE(ours.at("outcome") == "ok");
  INFO(theirs.dump(1));
  INFO(ours.dump(1));
  const auto number = [](const nlohmann::json& row, const char* name) {
    return row.at("measures").at(name).at("value").get<double>();
  };
  CHECK(number(theirs, "N") == 2000);
  CHECK(number(theirs, "H_V") == number(ours, "H_V")); // the same radii, as both start from one packing
  CHECK(number(theirs, "phi") == Approx(number(ours, "phi")).margin(kSamePhi));
  CHECK(number(theirs, "z") == Approx(number(ours, "z")).margin(kSameContacts));
  // The program's scripts are kept with the packing.
  bool script = false;
  for (const auto& [name, digest] : digests(shop.folder() / "tamp-store" / "packings"))
    script = script || name.ends_with(".files/in.1");
  CHECK(script);
}

TEST_CASE("a job of LAMMPS that is out of time keeps what it reached, and its record says so", "[slow]") {
  const Workshop shop(TAMP_BINARY);
  shop.write("late.json", R"({"campaign": "late", "scene": {"unit": "um", "size": 10, "count": 400, "sides": "periodic",
    "psd": {"law": "monodisperse", "radius": 1}}, "methods": [{"name": "lammps-gravity", "force_balance": 1e-9,
    "kinetic_energy": 1e-30}], "metrics": ["phi"], "budget": {"wall_s": 10}})");
  const Said said = shop.tamp("run late.json");
  CAPTURE(said.out, said.err);
  const nlohmann::json row = shop.results("tamp-store").begin()->second;
  if (row.at("outcome") == "not-applicable") {
    WARN("skipped: " << row.at("reason"));
    return;
  }
  CHECK(said.code == 1);
  CHECK(row.at("outcome") == "time-limited");
  CHECK(row.at("measures").at("N").at("value") == 400);
  CHECK(row.at("measures").count("phi") == 0);
  const std::string reached = fmt::format("tamp-store/incoming/{}.files/reached.h5", row.at("key").get<std::string>());
  const Said audit = shop.tamp("audit --format json " + reached);
  INFO(audit.err);
  REQUIRE(audit.code == 0);
  CHECK(nlohmann::json::parse(audit.out).at("audits").at(0).at("measures").at("phi").at("value").get<double>() > 0.3);
}

TEST_CASE("an audit of a dump that LAMMPS wrote says what the record says, and finds what is planted in it", "[slow]") {
  const Workshop shop(TAMP_BINARY);
  shop.write("bed.json", R"({"campaign": "bed", "scene": {"unit": "um", "size": 10, "count": 150, "sides": "periodic",
    "psd": {"law": "lognormal", "mu_ln": 0.3, "sigma_ln": 0.3, "r_min": 0.5, "r_max": 4}},
    "methods": [{"name": "lammps-gravity", "overlap": 0.05}], "metrics": ["phi", "overlap", "hellinger"]})");
  shop.tamp("run bed.json");
  const nlohmann::json record = shop.results("tamp-store").begin()->second;
  if (record.at("outcome") == "not-applicable") {
    WARN("skipped: " << record.at("reason"));
    return;
  }
  REQUIRE(record.at("outcome") == "ok");
  // LAMMPS itself reads the packing and dumps it.
  REQUIRE(shop.tamp("export " + record.at("key").get<std::string>() + " --out bed.data").code == 0);
  shop.write("in.dump", "units lj\natom_style sphere\nboundary p p fs\nread_data bed.data\n"
                        "write_dump all custom own.dump id x y z radius modify sort id format float %.17g\n");
  const std::string move =
      fmt::format("cd '{}' && exec lmp -in in.dump -log dump.log -screen none", shop.folder().string());
  REQUIRE(tamp::run_process({.argv = {"sh", "-c", move}, .log = {}}).succeeded());

  const std::string law = " --law lognormal,mu_ln=0.3,sigma_ln=0.3,r_min=0.5,r_max=4,unit=um";
  const auto audit = [&](const std::string& file) {
    const Said said = shop.tamp("audit --format json --as-it-is " + file + law);
    INFO(said.err);
    REQUIRE(said.code == 0);
    return nlohmann::json::parse(said.out).at("audits").at(0);
  };
  const nlohmann::json found = audit("own.dump");
  for (const char* name : {"phi", "overlap_max", "H_V"}) {
    CAPTURE(name);
    CHECK(found.at("measures").at(name).at("value").get<double>() ==
          Approx(record.at("measures").at(name).at("value").get<double>()).epsilon(kDumpDigits));
  }

  const Dump own(tamp::read_file(shop.folder() / "own.dump"));
  REQUIRE(own.atoms.size() == 150);
  Dump planted = own; // far above the bed: two that overlap by half the smaller radius, and one that touches nothing
  planted.bounds[3] = "0 500";
  planted.atoms.insert(planted.atoms.end(), {{9001, 5, 5, 300, 1}, {9002, 5, 5, 302.5, 2}, {9003, 5, 5, 400, 1}});
  shop.write("planted.dump", planted.text());
  const nlohmann::json spoilt = audit("planted.dump");
  CHECK(spoilt.at("worst_overlaps").at(0).at("sphere") == 9001);
  CHECK(spoilt.at("worst_overlaps").at(0).at("other") == 9002);
  CHECK(spoilt.at("worst_overlaps").at(0).at("depth").get<double>() == Approx(0.5));
  const std::vector<int> floating = spoilt.at("floating").at("first");
  const bool sound = found.at("floating").at("count") == 0;
  CHECK(spoilt.at("floating").at("count").get<int>() == found.at("floating").at("count").get<int>() + 1);
  CHECK((!sound || floating == std::vector<int>{9003}));

  shop.write("shifted.dump", own.text(1e-3));
  const Said shifted = shop.tamp("audit shifted.dump" + law);
  CHECK(shifted.code == 2);
  CHECK_THAT(shifted.err, Contains("shifted.dump") && Contains("1e-3 times") && Contains("--unit mm"));
}
