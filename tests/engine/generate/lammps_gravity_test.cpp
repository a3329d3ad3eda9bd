// The generator lammps-gravity: what it asks LAMMPS for, what it refuses, and its beds beside the native engine's.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/generate/generator.h"
#include "engine/generate/lammps/lammps_program.h"
#include "engine/generate/lammps/lammps_script.h"
#include "engine/generate/settling_scene.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>

using namespace tamp;
using namespace tamp::test;

namespace {

Job small_job(std::int64_t dimension = 3) {
  Job job;
  job.scene.dimension = dimension;
  job.scene.size = {10};
  job.scene.count = 40;
  job.scene.sides = Sides::periodic;
  job.scene.psd = monodisperse_psd(1);
  job.scene = completed(job.scene);
  job.method.name = MethodName::lammps_gravity;
  job.method.dem_gravity.overlap = 0.05;
  job.method.dem_gravity.kinetic_energy = 1e-3;
  return job;
}

template <int D>
std::string script_of(const Job& job) {
  SettlingScene<D> scene({job, "script"});
  REQUIRE(scene.obstacle.empty());
  const SettleTask<D> task = scene.task({job, "script"}, true);
  return gravity_script(task, {.modulus = task.modulus, .step = 1e-3, .overlap = 0.1, .most_looks = 9});
}

bool holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

/// Whether there is no LAMMPS here; says so.
bool absent(const Generated& out) {
  if (out.outcome != Outcome::not_applicable)
    return false;
  WARN("skipped: " << out.reason);
  return true;
}

double measure_of(const Generated& out, std::string_view name) {
  for (const Measure& m : out.measures) {
    if (m.name == name)
      return m.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double mean_height(const Packing& p) {
  const auto d = static_cast<std::size_t>(p.dimension);
  double sum = 0;
  for (std::size_t i = 0; i < p.count(); ++i)
    sum += p.positions[(i + 1) * d - 1];
  return sum / static_cast<double>(p.count());
}

/// The program that LAMMPS is looked for as, while this lives.
class Lammps {
public:
  explicit Lammps(const char* command) {
    if (const char* stated = std::getenv(kLammpsVariable))
      before_ = stated;
    ::setenv(kLammpsVariable, command, 1);
  }
  ~Lammps() { before_.empty() ? ::unsetenv(kLammpsVariable) : ::setenv(kLammpsVariable, before_.c_str(), 1); }
  Lammps(const Lammps&) = delete;
  Lammps& operator=(const Lammps&) = delete;

private:
  std::string before_;
};

} // namespace

TEST_CASE("a script asks for what the material calls for, and for no more", "[lammps]") {
  Job job = small_job();
  const std::string smooth = script_of<3>(job);
  CHECK_FALSE(holds(smooth, "mindlin"));
  CHECK_FALSE(holds(smooth, "nve/sphere"));
  CHECK_FALSE(holds(smooth, "enforce2d"));
  CHECK(holds(smooth, "boundary p p f"));
  CHECK(holds(smooth, " bin\n")); // equal spheres need no collections
  CHECK_FALSE(holds(smooth, "xplane"));
  CHECK(holds(smooth, "zplane 0 NULL"));
  // Else energies would be per sphere, and the bed would seem to rest N times too early.
  CHECK(smooth.find("thermo_modify norm no") > smooth.find("thermo_style"));

  job.method.material.friction = 0.5;
  CHECK(holds(script_of<3>(job), "mindlin NULL 1.0 0.5"));
  CHECK(holds(script_of<3>(job), "nve/sphere"));

  job.method.material.adhesion = 1e-3;
  job.method.material.adhesion_model = AdhesionModel::dmt;
  CHECK(holds(script_of<3>(job), "pair_coeff * * dmt"));
  job.method.material.adhesion_model = AdhesionModel::jkr;
  CHECK(holds(script_of<3>(job), "pair_coeff * * jkr"));

  Job flat = small_job(2);
  flat.scene.sides = Sides::walls;
  CHECK(holds(script_of<2>(flat), "boundary f f p"));
  CHECK(holds(script_of<2>(flat), "fix plane all enforce2d"));
  CHECK(holds(script_of<2>(flat), "xplane 0 "));
  CHECK(holds(script_of<2>(flat), "4.18879"));
  flat.method.dem_gravity.flat_body = FlatBody::disc;
  CHECK_FALSE(holds(script_of<2>(flat), "4.18879")); // a disc weighs as its area
}

TEST_CASE("unequal spheres get collections that hold them all, and room for many neighbours", "[lammps]") {
  const std::string text = lammps_neighbours({1, 3, 40}, 0);
  CHECK(holds(text, " multi\n"));
  CHECK(holds(text, "comm_modify mode multi"));
  const std::size_t at = text.find("collection/interval ");
  REQUIRE(at != std::string::npos);
  std::istringstream in(text.substr(at + std::string("collection/interval ").size()));
  std::size_t count = 0;
  in >> count;
  std::vector<double> edges;
  for (double edge = 0; in >> edge;)
    edges.push_back(edge);
  CHECK(edges.size() == count);
  CHECK(std::is_sorted(edges.begin(), edges.end()));
  CHECK(edges.back() > 80);
  // One collection for the few spheres far below the median: a grid as fine as they are would fill the memory.
  std::vector<double> dust(100, 1.0);
  dust.push_back(0.01);
  dust.push_back(3);
  CHECK(holds(lammps_neighbours(dust, 0), "collection/interval 3 2 4 6.0"));
  // At ratio 40 a large sphere can be covered by more small ones than LAMMPS expects of any.
  const std::string crowd = lammps_neighbours(std::vector<double>(100000, 1.0), 0);
  CHECK(holds(crowd, "one 2000 page 20000"));
  std::vector<double> mixed(100000, 1.0);
  mixed.push_back(40);
  CHECK(holds(lammps_neighbours(mixed, 0), "one 16810 page 168100"));
}

TEST_CASE("version and styles are read from the program's help", "[lammps]") {
  const LammpsProgram program = parse_lammps_help("\nLarge-scale Atomic/Molecular Massively Parallel Simulator - 1 Jan "
                                                  "2030\n\nUsage\n* Pair styles:\n\nborn  granular\ngw\n* Fix "
                                                  "styles\n\ngravity  nve\n");
  CHECK(program.version == "1 Jan 2030");
  CHECK(program.styles == std::set<std::string>{"pair born", "pair granular", "pair gw", "fix gravity", "fix nve"});
  CHECK_NOTHROW(program.require({"pair granular", "fix nve"}));
  CHECK_THROWS_AS(program.require({"fix wall/gran"}), NotApplicable);
  CHECK(parse_lammps_help("bash: no such program").version.empty());
}

TEST_CASE("without the program, or the styles, the outcome is not-applicable and says what to install", "[lammps]") {
  for (const char* command : {"/nowhere/lmp", "true", "false"}) {
    const Lammps other(command);
    const Generated out = generate({small_job(), "absent"});
    CHECK(out.outcome == Outcome::not_applicable);
    CHECK(out.reason.find("apt-get install lammps") != std::string::npos);
  }
  const ScratchFolder folder;
  write_atomically(folder / "lmp", "#!/bin/sh\necho 'Massively Parallel Simulator - 1999'\necho '* Fix styles'\n");
  std::filesystem::permissions(folder / "lmp", std::filesystem::perms::owner_all);
  const Lammps old((folder / "lmp").c_str());
  const Generated out = generate({small_job(), "old"});
  CHECK(out.outcome == Outcome::not_applicable);
  CHECK(out.reason.find("has no atom sphere") != std::string::npos);
}

TEST_CASE("what LAMMPS complains of is the reason of a failure", "[lammps]") {
  const ScratchFolder folder;
  LammpsProgram program;
  try {
    program = find_lammps(folder.path());
  } catch (const NotApplicable& e) {
    WARN("skipped: " << e.what());
    return;
  }
  write_atomically(folder / "in.bad", "units lj\nno_such_command\n");
  CHECK_THROWS_WITH(run_lammps(program, folder.path(), "in.bad"), Catch::Contains("Unknown command: no_such_command"));
}

TEST_CASE("a bed that is out of time is handed back as far as it came, and is no success", "[lammps]") {
  Job job = small_job();
  job.scene.count = 400;
  job.method.dem_gravity.force_balance = 1e-9; // which takes longer
  job.method.dem_gravity.kinetic_energy = 1e-30;
  const Generated out = generate({.job = job, .key = "late", .wall_s = 3});
  if (absent(out))
    return;
  CHECK(out.outcome == Outcome::time_limited);
  CHECK(out.reason.find("not at rest after 1 of the 3 s") == 0);
  CHECK(out.packing.count() == 400);
  CHECK(out.measures.front().value == 400);
}

TEST_CASE("LAMMPS settles what the native engine settles: small beds in 2D and 3D", "[lammps]") {
  for (const std::int64_t dimension : {2, 3}) {
    Job job = small_job(dimension);
    const ScratchFolder folder;
    const Generated theirs = generate({.job = job, .key = "twin", .folder = folder / "files"});
    if (absent(theirs))
      return;
    INFO(theirs.reason);
    REQUIRE(theirs.outcome == Outcome::ok);
    CHECK(theirs.programs.at("LAMMPS").find("pair granular") != std::string::npos);
    CHECK(holds(read_file(folder / "files/in.1"), "# 40 spheres fall"));
    CHECK_FALSE(std::filesystem::exists(folder / "files/start.data"));
    job.method.name = MethodName::dem_gravity;
    const Generated ours = generate({job, "twin"});
    CHECK(theirs.packing.radii == ours.packing.radii);
    CHECK(theirs.packing.size == ours.packing.size);
    CHECK(theirs.packing.boundary == ours.packing.boundary);
    CHECK(measure_of(theirs, "residual_overlap") <= 0.05);
    CHECK(measure_of(theirs, "kinetic_energy") < 1e-3);
    CHECK(mean_height(theirs.packing) == Approx(mean_height(ours.packing)).epsilon(0.15));
  }
}
