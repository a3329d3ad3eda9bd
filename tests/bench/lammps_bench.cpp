// The native discrete element methods against LAMMPS (Debian's lmp), one thread each, in one run: the cost of a step
// (same cloud, radii, contact law, step and number of steps), and the whole way from the cloud to a bed at rest with
// the same tolerated overlap. Checks its answers too: beds that differ make the benchmark fail.
#include "engine/base/files.h"
#include "engine/base/host.h"
#include "engine/base/process.h"
#include "engine/base/random.h"
#include "engine/contact/contact_law.h"
#include "engine/dem/settle.h"
#include "engine/dem/time_step.h"
#include "engine/dem/verlet.h"
#include "engine/generate/loose_cloud.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

namespace {

using namespace tamp;
namespace fs = std::filesystem;

// Units in which the mean radius, the density and gravity are 1.
constexpr double kModulus = 1e6; // E*
constexpr double kPoisson = 0.3;
constexpr double kRestitution = 0.5;
constexpr double kOverlap = 4e-3; // of the deepest contacts, to choose the step by
constexpr double kSkin = 0.15;    // of our list; LAMMPS gets the same margin
constexpr int kSteps = 40000;     // half of them on the settled bed
/// Two beds of some thousand spheres from one cloud: their motion parts after the first collisions, their heights do
/// not.
constexpr double kSameHeight = 0.01;
/// Beds at rest, one settled by motion and one by energy, have heights that part a little more.
constexpr double kSameHeightAtRest = 0.02;
/// A bed rests when a sphere's kinetic energy is this many times its weight times its radius.
constexpr double kAtRest = 1e-4;
constexpr int kRestLook = 2000;  // steps between LAMMPS's looks whether it rests
constexpr int kMostLooks = 1000; // after which it is stopped
constexpr double kRestOverlap = 1e-3;

struct Bed {
  double height = 0;  // mean, of the centres
  double kinetic = 0; // mean energy of a sphere's translation
  double cpu_s = 0;   // of the steps alone
  double steps = 0;
};

struct SceneOf {
  Cloud<3> cloud;
  Vec<3> size;
  double friction;
  double dt;
  double modulus = kModulus;
  bool until_rest = false;
};

double mass(double r) {
  return 4.0 / 3.0 * std::numbers::pi * r * r * r;
}

SceneOf scene(std::size_t n, double edge, double friction) {
  SceneOf s{{}, {edge, edge, 1}, friction, 0};
  s.cloud = loose_cloud<3>(s.size, {true, true, false}, std::vector<double>(n, 1.0), 0.3, RandomStream("lammps", 0));
  double top = 0;
  for (const Vec<3>& c : s.cloud.centres)
    top = std::max(top, c[2]);
  s.size[2] = 1.2 * top;
  s.dt = shortest_collision(kModulus, 1, mass(1), std::sqrt(2 * top), kOverlap) / kStepsPerCollision;
  return s;
}

template <class Friction>
Bed native(const SceneOf& s) {
  using Law = ContactLaw<Hertz, TsujiDamping, Friction>;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<double> masses;
  for (const double r : s.cloud.radii)
    masses.push_back(mass(r));
  State<3, Law> state = at_rest<3, Law>(s.cloud.centres, s.cloud.radii, masses, 1);
  Law law{{kModulus}, {damping_of_restitution(kRestitution)}};
  if constexpr (Friction::turns) {
    const Elastic solid{2 * (1 - kPoisson * kPoisson) * kModulus, kPoisson};
    law.friction = {effective_shear_modulus(solid, solid), s.friction, 1};
  }
  SearchBox<3> box;
  box.size = s.size;
  box.periodic = {true, true, false};
  box.wall[2] = {true, false};
  ForceField<3, Law> field(law, box, kSkin);
  field.evaluate(state, 0);
  const double start = thread_cpu_seconds();
  for (int i = 0; i < kSteps; ++i)
    verlet_step(state, field, s.dt);
  Bed bed;
  bed.cpu_s = thread_cpu_seconds() - start;
  for (std::size_t i = 0; i < state.count(); ++i) {
    bed.height += state.centre[i][2] / static_cast<double>(state.count());
    bed.kinetic += 0.5 * masses[i] * state.velocity[i].squaredNorm() / static_cast<double>(state.count());
  }
  return bed;
}

double number_after(const std::string& text, std::string_view word) {
  const std::size_t at = text.rfind(word);
  return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + word.size(), nullptr);
}

/// Of LAMMPS's loop: wall-clock time times the share of the processor that it had.
double loop_cpu_s(const std::string& log) {
  const std::size_t percent = log.rfind("% CPU use");
  const std::size_t line = log.rfind('\n', percent);
  if (percent == std::string::npos || line == std::string::npos)
    return std::nan("");
  return number_after(log, "Loop time of ") * std::strtod(log.c_str() + line, nullptr) / 100;
}

/// Empty if lmp is missing or failed.
std::optional<Bed> lammps(const SceneOf& s) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("tamp-lammps-{}", ::getpid());
  fs::create_directories(folder);
  std::string data = fmt::format("a loose cloud\n\n{} atoms\n1 atom types\n0 {:.17g} xlo xhi\n0 {:.17g} ylo yhi\n0 "
                                 "{:.17g} zlo zhi\n\nAtoms # sphere\n\n",
                                 s.cloud.radii.size(), s.size[0], s.size[1], s.size[2]);
  for (std::size_t i = 0; i < s.cloud.radii.size(); ++i) {
    const Vec<3>& c = s.cloud.centres[i];
    data += fmt::format("{} 1 {:.17g} 1 {:.17g} {:.17g} {:.17g}\n", i + 1, 2 * s.cloud.radii[i], c[0], c[1], c[2]);
  }
  const double young = 2 * (1 - kPoisson * kPoisson) * s.modulus;
  const std::string law =
      fmt::format("hertz/material {:.17g} {:.17g} {} tangential {} damping tsuji", young,
                  lammps_restitution(damping_of_restitution(kRestitution)), kPoisson,
                  s.friction > 0 ? fmt::format("mindlin NULL 1.0 {:.17g}", s.friction) : "linear_nohistory 0.0 0.0");
  const std::string run = s.until_rest ? fmt::format(R"(label again
variable look loop {0}
run {1} pre no post no
variable rests equal "ke/atoms < {2:.17g}"
if "${{rests}} == 1" then "jump SELF end"
next look
jump SELF again
label end
run {1})",
                                                     kMostLooks, kRestLook, kAtRest * mass(1))
                                       : fmt::format("thermo {0}\nrun {0}", kSteps);
  const std::string script = fmt::format(R"(units si
atom_style sphere
boundary p p f
newton off
comm_modify vel yes
read_data cloud.data
pair_style granular
pair_coeff * * {0}
neighbor {1:.17g} bin
neigh_modify delay 0 every 1 check yes
fix weight all gravity 1 vector 0 0 -1
fix floor all wall/gran granular {0} zplane 0 NULL
fix motion all nve/sphere
timestep {2:.17g}
{3}
variable height equal xcm(all,z)
variable kinetic equal ke/atoms
variable steps equal step
print "mean_height ${{height}} mean_kinetic ${{kinetic}} steps ${{steps}}"
)",
                                         law, 2 * kSkin, s.dt, run);
  write_atomically(folder / "cloud.data", data);
  write_atomically(folder / "in.cloud", script);
  std::optional<Bed> bed;
  try {
    const std::string move = fmt::format("cd '{}' && OMP_NUM_THREADS=1 exec lmp -in in.cloud", folder.string());
    const ProcessResult ended = run_process({.argv = {"sh", "-c", move}, .log = folder / "log"});
    const std::string log = read_file(folder / "log");
    if (ended.succeeded())
      bed = Bed{number_after(log, "mean_height "), number_after(log, "mean_kinetic "),
                s.until_rest ? ended.cpu_s : loop_cpu_s(log), number_after(log, "steps ")};
  } catch (const std::exception&) {
    bed.reset();
  }
  fs::remove_all(folder);
  return bed;
}

void against_lammps(benchmark::State& state, std::size_t n, double edge, double friction) {
  const SceneOf s = scene(n, edge, friction);
  Bed ours;
  std::optional<Bed> theirs;
  for ([[maybe_unused]] auto _ : state) {
    theirs = lammps(s);
    ours = friction > 0 ? native<Mindlin>(s) : native<NoFriction>(s);
  }
  if (!theirs)
    return state.SkipWithError("lmp is missing or failed: apt-get install lammps");
  if (!(std::abs(ours.height / theirs->height - 1) < kSameHeight))
    state.SkipWithError("the beds have different heights");
  const double steps = static_cast<double>(n) * kSteps;
  state.counters["N"] = static_cast<double>(n);
  state.counters["ns_per_particle_step"] = 1e9 * ours.cpu_s / steps;
  state.counters["lammps_ns"] = 1e9 * theirs->cpu_s / steps;
  state.counters["over_lammps"] = ours.cpu_s / theirs->cpu_s;
  state.counters["height"] = ours.height;
  state.counters["lammps_height"] = theirs->height;
  state.counters["kinetic"] = ours.kinetic;
  state.counters["lammps_kinetic"] = theirs->kinetic;
}

/// Ours finds the stiffness that the tolerated overlap asks for; LAMMPS is given it.
void to_rest(benchmark::State& state, std::size_t n, double edge, double friction) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  SceneOf s = scene(n, edge, friction);
  SettleTask<3> task;
  task.box.size = s.size;
  task.box.periodic = {true, true, false};
  task.box.wall[2] = {true, false};
  task.centres = s.cloud.centres;
  task.radii = s.cloud.radii;
  for (const double r : task.radii)
    task.masses.push_back(mass(r));
  task.effects.friction = friction > 0;
  task.friction = friction;
  task.poisson = kPoisson;
  task.restitution = kRestitution;
  task.overlap = kRestOverlap;
  task.force_balance = 5e-3;
  task.kinetic_energy = kAtRest;
  task.modulus = friction > 0 ? 1e5 : 1e4;
  task.largest_modulus = 1e12;
  Settled<3> bed;
  double cpu_s = 0;
  std::optional<Bed> theirs;
  for ([[maybe_unused]] auto _ : state) {
    const double start = thread_cpu_seconds();
    bed = settle(task);
    cpu_s = thread_cpu_seconds() - start;
    s.modulus = bed.modulus;
    s.until_rest = true;
    double top = 0;
    for (const Vec<3>& c : s.cloud.centres)
      top = std::max(top, c[2]);
    s.dt = shortest_collision(bed.modulus, 1, mass(1), std::sqrt(2 * top), kRestOverlap) / kStepsPerCollision;
    theirs = lammps(s);
  }
  if (!theirs)
    return state.SkipWithError("lmp is missing or failed: apt-get install lammps");
  double height = 0;
  for (const Vec<3>& c : bed.centres)
    height += c[2] / static_cast<double>(n);
  if (!bed.at_rest || !(std::abs(height / theirs->height - 1) < kSameHeightAtRest))
    state.SkipWithError("the beds have different heights, or ours does not rest");
  state.counters["over_lammps"] = cpu_s / theirs->cpu_s;
  state.counters["cpu_s"] = cpu_s;
  state.counters["lammps_cpu_s"] = theirs->cpu_s;
  state.counters["steps"] = static_cast<double>(bed.steps);
  state.counters["lammps_steps"] = theirs->steps;
  state.counters["height"] = height;
  state.counters["lammps_height"] = theirs->height;
}

} // namespace

BENCHMARK_CAPTURE(to_rest, frictionless, 2000, 20, 0)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(to_rest, friction_0577, 2000, 20, 0.577)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(against_lammps, frictionless, 5000, 36, 0)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(against_lammps, friction_0577, 5000, 36, 0.577)->Iterations(1)->Unit(benchmark::kSecond);
