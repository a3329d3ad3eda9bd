// CSV and XYZ as other programs write them, and what is wrong with wrong ones.
#include "engine/base/error.h"
#include "store/formats/format.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace tamp;
using Catch::Matchers::Contains;

namespace {

/// Files of one test by their text.
class Files {
public:
  ReadPacking read(const std::string& name, const std::string& text, const Surroundings& stated = {}) const {
    std::ofstream(folder_ / name, std::ios::binary | std::ios::trunc) << text;
    return read_foreign(folder_ / name, stated);
  }

private:
  ScratchFolder folder_;
};

void check_two(const ReadPacking& read) {
  CHECK(read.packing.dimension == 3);
  CHECK(read.packing.radii == std::vector<double>{1, 0.5});
}

} // namespace

TEST_CASE("CSV is read as spreadsheets and scripts write it") {
  const Files files;
  const ReadPacking plain = files.read("p.csv", "x,y,z,r\n1,1,1,1\n3,3,3,0.5\n");
  check_two(plain);
  CHECK(plain.packing.boundary[0] == Boundary::open); // found, not told
  CHECK(plain.packing.size == std::array<double, 3>{3.5, 3.5, 3.5});
  CHECK_FALSE(plain.said.unit);
  check_two(files.read("p.csv", "\"X\";\"Y\";\"Z\";\"Diameter\"\r\n1;1;1;2\r\n3;3;3;1"));
  const ReadPacking more =
      files.read("p.csv", "id\tkind\tRadius [mm]\tz [mm]\ty\tx\n2\ta\t0.5\t3\t3\t3\n1\tb\t1\t1\t1\t1\n");
  check_two(more);
  CHECK(more.packing.unit == LengthUnit::mm);
  CHECK(more.packing.positions[0] == 1);
  CHECK(files.read("p.csv", "# a remark\n\nx (µm),y (µm),r (µm)\n1,1,1\n").packing.dimension == 2);
}

TEST_CASE("a wrong CSV is refused with the line and the reason") {
  const Files files;
  const auto refused = [&](const std::string& text, const std::string& message) {
    CHECK_THROWS_AS(files.read("p.csv", text), InputError);
    CHECK_THROWS_WITH(files.read("p.csv", text), Contains(message));
  };
  refused("", "must name the columns");
  refused("1,1,1,1\n", "p.csv:1: the first line must name the columns");
  refused("x,y,z,r\n", "no sphere");
  refused("x,y,z,r\n1,1,1\n", "p.csv:2: 3 columns; the header has 4");
  refused("x,y,z,r\n1,1,1,1\n\n2,nan,2,1\n", "p.csv:4: sphere 2 has the coordinate y = nan");
  refused("x,y,z,r\n1,1,1,0\n", "p.csv:2: sphere 1 has the radius 0");
  refused("x,y,z,r\n1,1,1,-2\n", "the radius -2");
  refused("x,y,z,r\n1,1,1,\n", "p.csv:2: the radius is \"\"");
  refused("x,y,z,r,d\n", "two columns tell the same");
  refused("x (um),y (um),z (mm),r (um)\n", "different units");
  refused("x (inch),y,z,r\n", "unknown unit \"inch\"");
  refused("id,x,y,z,r\n4,1,1,1,1\n4,2,2,2,1\n", "p.csv:3: sphere 4 stood already in line 2");
  refused("# count 3\nx,y,z,r\n1,1,1,1\n", "ends after 1 spheres, but says that it has 3");
  refused("# box 0 2 0 2 0 2\nx,y,z,r\n1,1,1,1\n1,1,2.5,1\n", "p.csv:4: sphere 2 at z = 2.5 lies beyond the wall at 2");
  refused("x,y,z,r\n0,0,0,1e-12\n9,9,9,1\n", "p.csv:2: sphere 1 of radius 1e-12 is lost");
  refused("# boundary periodic wall wall\nx,y,z,r\n1,1,1,1\n", "periodic, but nothing says its period");
}

TEST_CASE("extended XYZ is read as OVITO and ASE write it") {
  const Files files;
  const std::string ase =
      "2\nLattice=\"4.0 0.0 0.0 0.0 4.0 0.0 0.0 0.0 5.0\" Properties=species:S:1:pos:R:3:radius:R:1 "
      "pbc=\"T T F\"\nX 1 1 1 1\nX 3 3 3 0.5\n";
  const ReadPacking read = files.read("p.xyz", ase);
  check_two(read);
  CHECK(read.packing.size == std::array<double, 3>{4, 4, 5});
  CHECK(read.packing.boundary == std::array{Boundary::periodic, Boundary::periodic, Boundary::wall});
  const std::string ovito = "2\nLattice=\"4.0 0.0 0.0 0.0 4.0 0.0 0.0 0.0 5.0\" Origin=\"-2 -2 0\" "
                            "Properties=id:I:1:pos:R:3:radius:R:1:velo:R:3\n2 1 1 3 0.5 0 0 0\n1 -1 -1 1 1 0 0 0\n";
  const ReadPacking other = files.read("p.xyz", ovito);
  check_two(other);
  CHECK(other.packing.positions == read.packing.positions);
  check_two(files.read("p.xyz", "1\nProperties=pos:R:3:radius:R:1\n0 0 0 9\n" + ase)); // the last frame
}

TEST_CASE("a wrong XYZ is refused with the line and the reason") {
  const Files files;
  const std::string head = "2\nProperties=pos:R:3:radius:R:1\n";
  const auto refused = [&](const std::string& text, const std::string& message) {
    CHECK_THROWS_AS(files.read("p.xyz", text), InputError);
    CHECK_THROWS_WITH(files.read("p.xyz", text), Contains(message));
  };
  refused("", "no sphere");
  refused("two\n", "p.xyz:1: the number of spheres is \"two\"");
  refused("2\n", "ends before the comment line");
  refused("1\nwater\nO 0 0 0\n", "no radii");
  refused("1\nProperties=species:S:1:pos:R:3\nO 0 0 0\n", "no property radius");
  refused("1\nProperties=pos:R\n", "again and again");
  refused(head + "0 0 0 1\n", "p.xyz:4: the file ends before sphere 2 of 2");
  refused(head + "0 0 0 1\n0 0 1\n", "p.xyz:4: 3 columns");
  refused(head + "0 0 0 1\n0 0 inf 1\n", "p.xyz:4: sphere 2 has the coordinate z = inf");
  refused("1\nLattice=\"1 1 0 0 1 0 0 0 1\" Properties=pos:R:3:radius:R:1\n0 0 0 1\n", "skewed");
}

TEST_CASE("text of Yade and MercuryDPM is read as these programs write it") {
  const Files files;
  check_two(files.read("p.txt", "#format x_y_z_r\n1 1 1 1\n3\t3\t3\t0.5\n"));
  check_two(files.read("p.txt", "# x y z r\n1 1 1 1\n3 3 3 0.5\n"));
  CHECK_THROWS_WITH(files.read("p.txt", "#format x_y_z\n1 1 1\n"), Contains("p.txt:1: columns x_y_z"));
  CHECK_THROWS_WITH(files.read("p.txt", "1 1 1 1\n1 1 1\n"), Contains("p.txt:2: 3 columns"));

  const std::string early = "1 0 -1 -1 -1 3 3 3\n0 0 0 0 0 0 9 0 0 0 0 0 0 0\n";
  const std::string late = "2 0.5 -1 -1 -1 3 3 3\n0 0 0 7 7 7 1 0 0 0 0 0 0 0\n2 2 2 0 0 0 0.5 0 0 0 0 0 0 1\n";
  const ReadPacking last = files.read("p.data", early + late); // not LAMMPS's, though both call it .data
  check_two(last);
  CHECK(last.packing.size == std::array<double, 3>{4, 4, 4});
  CHECK(last.packing.positions == std::vector<double>{1, 1, 1, 3, 3, 3});
  CHECK_THROWS_WITH(files.read("p.data", late.substr(0, late.size() - 5)), Contains("p.data:3: 12 columns"));
  CHECK_THROWS_WITH(files.read("p.data", late.substr(0, late.rfind("2 2 2"))), Contains("truncated"));
}
