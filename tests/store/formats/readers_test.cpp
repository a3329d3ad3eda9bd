// Other programs read what we write, and we read what they write: VTK, and a parser of XYZ that is not ours.
#include "engine/base/files.h"
#include "engine/base/process.h"
#include "store/formats/format.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/engine/model/some_packing.h"

#include <catch2/catch.hpp>

using namespace tamp;

namespace {

ProcessResult python(const std::vector<std::string>& arguments, const std::filesystem::path& log) {
  std::vector<std::string> argv = {"/usr/bin/python3"}; // Debian's, which has Debian's modules
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  argv[1] = std::string(TAMP_SOURCE_DIR "/tests/store/formats/") + arguments[0];
  return run_process({.argv = argv, .log = log, .limits = {.wall_s = 60}});
}

} // namespace

TEST_CASE("VTK reads our points and arrays, and we read what VTK writes in base64") {
  const ScratchFolder folder;
  const Packing packing = test::some_packing(3, 100);
  format_named("vtp").write(folder / "p.vtp", packing, {});
  format_named("csv").write(folder / "p.csv", packing, {});
  const ProcessResult ended =
      python({"vtk_reader.py", folder / "p.vtp", folder / "p.csv", folder / "vtk.vtp"}, folder / "log");
  if (ended.code == 77) {
    WARN("skipped: python3-vtk9 is not installed");
    return;
  }
  INFO(read_file(folder / "log"));
  REQUIRE(ended.succeeded());
  Surroundings stated; // VTK may write field data in its own way; the spheres are what counts
  for (std::size_t a = 0; a < 3; ++a) {
    stated.box[a] = {0, packing.size[a]};
    stated.boundary[a] = packing.boundary[a];
  }
  test::check_same(read_foreign(folder / "vtk.vtp", stated).packing, packing);
}

TEST_CASE("an XYZ parser that is not ours reads our extended XYZ") {
  const ScratchFolder folder;
  const Packing packing = test::some_packing(3, 100);
  format_named("xyz").write(folder / "p.xyz", packing, {});
  format_named("csv").write(folder / "p.csv", packing, {});
  const ProcessResult ended = python({"xyz_reader.py", folder / "p.xyz", folder / "p.csv"}, folder / "log");
  INFO(read_file(folder / "log"));
  CHECK(ended.succeeded());
}
