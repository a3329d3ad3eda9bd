// Packings through LAMMPS's text formats and back, the real lmp as reader and writer, and damaged files.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/process.h"
#include "engine/base/random.h"
#include "engine/model/lammps_text.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/engine/model/some_packing.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <fstream>

using namespace tamp;
using Catch::Matchers::Contains;

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string dump_text(const std::string& atoms, const std::string& columns = "id x y z radius", int step = 7,
                      int count = 2, const std::string& sides = "pp pp ff") {
  return fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}\n-1 1\n0 2\n0 4\nITEM: ATOMS "
                     "{}\n{}",
                     step, count, sides, columns, atoms);
}

const std::string kTwo = "2 0.5 1 1 0.25\n1 -0.5 1 3 0.5\n";

} // namespace

TEST_CASE("a packing comes back from LAMMPS's formats as it went") {
  const ScratchFolder folder;
  for (const int dimension : {2, 3}) {
    for (const LengthUnit unit : {LengthUnit::nm, LengthUnit::um, LengthUnit::mm, LengthUnit::m}) {
      Packing packing = test::some_packing(dimension, 200);
      packing.unit = unit;
      write_lammps_data(folder / "p.data", packing);
      const ReadPacking data = read_lammps_data(folder / "p.data");
      test::check_same(data.packing, packing);
      CHECK(data.said.unit == unit);
      write_lammps_dump(folder / "p.dump", packing, 42);
      const ReadPacking dump = read_lammps_dump(folder / "p.dump");
      test::check_same(dump.packing, packing);
      CHECK(dump.step == 42);
    }
  }
}

TEST_CASE("columns of a dump may have any order, scale and name") {
  const ScratchFolder folder;
  write(folder / "plain", dump_text(kTwo));
  const ReadPacking plain = read_lammps_dump(folder / "plain");
  CHECK(plain.step == 7);
  CHECK(plain.origin == std::array<double, 3>{-1, 0, 0});
  CHECK(plain.packing.size == std::array<double, 3>{2, 2, 4});
  CHECK(plain.packing.boundary == std::array{Boundary::periodic, Boundary::periodic, Boundary::wall});
  CHECK(plain.packing.positions == std::vector<double>{0.5, 1, 3, 1.5, 1, 1}); // in the order of the ids
  CHECK(plain.packing.radii == std::vector<double>{0.5, 0.25});
  CHECK_FALSE(plain.said.unit);

  write(folder / "scaled", dump_text("9 0.5 2 0.25 0.75 0.5\n9 1 1 0.75 0.25 0.5\n", "vx diameter id zs xs ys"));
  test::check_same(read_lammps_dump(folder / "scaled").packing, plain.packing);
  write(folder / "unwrapped", dump_text("0.25 1 1 0.5\n0.5 3 1 -0.5\n", "radius zu y xu"));
  CHECK(read_lammps_dump(folder / "unwrapped").packing.radii == std::vector<double>{0.25, 0.5});
}

TEST_CASE("an open axis begins at its floor, or at the lowest point of the spheres") {
  const ScratchFolder folder;
  write(folder / "floor", dump_text(kTwo, "id x y z radius", 7, 2, "pp pp fs"));
  CHECK(read_lammps_dump(folder / "floor").packing.size[2] == 4);
  CHECK(read_lammps_dump(folder / "floor").packing.boundary[2] == Boundary::open);
  write(folder / "shrunk", dump_text(kTwo, "id x y z radius", 7, 2, "pp pp ss"));
  const ReadPacking shrunk = read_lammps_dump(folder / "shrunk");
  CHECK(shrunk.origin[2] == 0.75);
  CHECK(shrunk.packing.size[2] == 2.75);
}

TEST_CASE("a data file's box holds the spheres of a heap that is higher than its open box") {
  const ScratchFolder folder;
  Packing heap;
  heap.dimension = 3;
  heap.size = {4, 4, 4};
  heap.boundary = {Boundary::periodic, Boundary::periodic, Boundary::open};
  heap.radii = {1, 0.5};
  heap.positions = {1, 1, 1, 2, 2, 6};
  write_lammps_data(folder / "heap", heap);
  CHECK(read_lammps_data(folder / "heap").packing.size == std::array<double, 3>{4, 4, 6.5});
  heap.positions[5] = 3;
  write_lammps_data(folder / "low", heap);
  test::check_same(read_lammps_data(folder / "low").packing, heap);
}

TEST_CASE("the last snapshot counts, or the one of a step, or the last that is whole") {
  const ScratchFolder folder;
  const std::string first = dump_text("1 0 1 1 0.1\n", "id x y z radius", 10, 1);
  const std::string second = dump_text("1 0 1 2 0.2\n", "id x y z radius", 20, 1);
  write(folder / "two", first + second);
  CHECK(read_lammps_dump(folder / "two").step == 20);
  CHECK(read_lammps_dump(folder / "two", {}, {.step = 10}).packing.radii == std::vector<double>{0.1});
  CHECK_THROWS_WITH(read_lammps_dump(folder / "two", {}, {.step = 15}), Contains("no snapshot of step 15"));
  for (const std::size_t kept : {second.size() - 12, std::size_t{60}, std::size_t{20}}) {
    write(folder / "cut", first + second.substr(0, kept));
    CHECK_THROWS_AS(read_lammps_dump(folder / "cut"), InputError);
    CHECK(read_lammps_dump(folder / "cut", {}, {.pass_over_cut = true}).step == 10);
  }
}

TEST_CASE("what the user states counts more than the file") {
  const ScratchFolder folder;
  write(folder / "plain", dump_text(kTwo));
  Surroundings stated;
  stated.unit = LengthUnit::mm;
  stated.box[2] = {-1, 9};
  stated.boundary[0] = Boundary::wall;
  const ReadPacking read = read_lammps_dump(folder / "plain", stated);
  CHECK(read.packing.unit == LengthUnit::mm);
  CHECK(read.packing.size[2] == 10);
  CHECK(read.packing.boundary[0] == Boundary::wall);
  CHECK(read.packing.positions[2] == 4);
}

TEST_CASE("a wrong dump is refused with the line and the reason") {
  struct Bad {
    std::string text;
    std::string message;
  };
  const std::vector<Bad> all = {
      {dump_text("1 0 1 1 0.5\n"), "file:11: the file ends before atom 2 of 2: it is truncated"},
      {dump_text("1 0 1 1 0.5\n2 0 1 3\n"), "file:11: 4 columns; atom 2 of 2 has 5"},
      {dump_text("1 0 1 1 0.5\n2 0 nan 3 0.5\n"), "file:11: sphere 2 has the coordinate y = nan"},
      {dump_text("1 0 1 1 0.5\n2 0 x 3 0.5\n"), "file:11: y is \"x\", which is no number"},
      {dump_text("1 0 1 1 -0.5\n2 0 1 3 0.5\n"), "file:10: sphere 1 has the radius -0.5"},
      {dump_text("1 0 1 1 0\n2 0 1 3 0.5\n"), "file:10: sphere 1 has the radius 0"},
      {dump_text("2 0 1 1 0.5\n2 0 1 3 0.5\n"), "file:11: sphere 2 stood already in line 10"},
      {dump_text("1 0 1 1 0.5\n2 0 1 5 0.5\n"), "file:11: sphere 2 at z = 5 lies beyond the wall at 4"},
      {dump_text("1 0 1 1 0.5\n2 0 1 3 1.5\n"), "file:11: sphere 2 of radius 1.5 is wider than the period 2"},
      {dump_text(kTwo + "3 0 1 2 0.5\n"), "more atoms"},
      {dump_text(kTwo, "id x y z mass"), "no column radius or diameter"},
      {dump_text(kTwo, "id a y z radius"), "no column x"},
      {"some text\n", "file:1: a line \"ITEM: …\" should stand here"},
      {"", "no snapshot"},
      {dump_text("", "id x y z radius", 7, 0), "no sphere"},
      {dump_text(std::string(2'000'000, '1')), "file:10: a line of more than"},
  };
  const ScratchFolder folder;
  for (const Bad& bad : all) {
    write(folder / "file", bad.text);
    CHECK_THROWS_MATCHES(read_lammps_dump(folder / "file"), InputError,
                         Catch::Matchers::Predicate<InputError>(
                             [&](const InputError& e) {
                               UNSCOPED_INFO(e.what());
                               return std::string(e.what()).find(bad.message) != std::string::npos;
                             },
                             bad.message));
  }
  CHECK_THROWS_WITH(read_lammps_dump(folder / "absent"), Contains("cannot open"));
  CHECK_THROWS_AS(read_lammps_dump(folder.path()), InputError);
}

TEST_CASE("a wrong data file is refused with the line and the reason") {
  const ScratchFolder folder;
  write_lammps_data(folder / "good", test::some_packing(3, 20));
  const std::string good = read_file(folder / "good");
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& message) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    write(folder / "file", text);
    CHECK_THROWS_WITH(read_lammps_data(folder / "file"), Contains(message));
  };
  refused("20 atoms", "21 atoms", "file:32: the file ends before atom 21 of 21");
  refused("20 atoms", "19 atoms", "file:31: more than the 19 atoms");
  refused("20 atoms", "", "no line \"N atoms\"");
  refused("Atoms # sphere", "Atoms # full", "file:10: atoms of style \"full\"");
  refused("\n7 1 ", "\n6 1 ", "stood already");
  refused("\n7 1 ", "\n7 1 0 ", "8 columns");
  refused("\n7 1 ", "\n7 ", "6 columns");
  refused("zhi", "zhi\n1 0 0 xy xz yz", "skewed");
  for (std::size_t cut = 0; cut + 300 < good.size(); cut += 97) {
    write(folder / "cut", good.substr(0, cut));
    CHECK_THROWS_AS(read_lammps_data(folder / "cut"), InputError);
  }
}

TEST_CASE("LAMMPS reads our data file and we read its dump and data file: the same numbers") {
  const ScratchFolder folder;
  for (const int dimension : {2, 3}) {
    Packing packing = test::some_packing(dimension, 100);
    packing.unit = LengthUnit::um;
    packing.boundary = {Boundary::periodic, Boundary::wall, Boundary::wall};
    write_lammps_data(folder / "in.data", packing);
    write(folder / "script", fmt::format(R"(units micro
dimension {}
atom_style sphere
boundary p f {}
read_data in.data
dump d all custom 1 out.dump id x y z radius
dump_modify d format float %.17g units yes
run 0
write_data out.data
)",
                                         dimension, dimension == 2 ? "p" : "f"));
    const std::string command = fmt::format("cd '{}' && exec lmp -in script", folder.path().string());
    const ProcessResult ended = run_process({.argv = {"sh", "-c", command}, .log = folder / "log"});
    if (!ended.succeeded() && read_file(folder / "log").find("not found") != std::string::npos) {
      WARN("skipped: lmp is not installed");
      return;
    }
    INFO(read_file(folder / "log"));
    REQUIRE(ended.succeeded());
    const ReadPacking dump = read_lammps_dump(folder / "out.dump");
    test::check_same(dump.packing, packing);
    CHECK(dump.said.unit == LengthUnit::um);
    Surroundings sides;
    std::copy(packing.boundary.begin(), packing.boundary.end(), sides.boundary.begin());
    sides.unit = LengthUnit::um; // this version of write_data leaves it out
    test::check_same(read_lammps_data(folder / "out.data", sides).packing, packing);
  }
}
