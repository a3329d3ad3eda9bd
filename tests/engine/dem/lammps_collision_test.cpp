// Two spheres collide in tamp as they do in LAMMPS, step by step.
#include "engine/base/files.h"
#include "engine/base/process.h"
#include "engine/dem/verlet.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <numbers>
#include <sstream>

using namespace tamp;
namespace fs = std::filesystem;

namespace {

constexpr double kModulus = 1e5; // E*
constexpr double kPoisson = 0.3;
constexpr double kRestitution = 0.6;
constexpr double kFriction = 0.4;
constexpr int kSteps = 400;
/// Of the radii and of the speed of the approach.
constexpr double kAgreement = 1e-10;

struct Ball {
  double radius;
  Vec<3> centre, velocity, spin;
  [[nodiscard]] double mass() const { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }
};

/// Off-centre, of different sizes, the first one spinning: sticking, slipping and turning all occur.
std::vector<Ball> approaching() {
  return {{1, {4, 5, 5}, {1, 0.2, 0}, {0, 0.3, -0.5}}, {0.7, {5.72, 5.3, 4.9}, {-1, 0, 0.1}, {0, 0, 0}}};
}

double step() {
  const double least = effective(approaching()[0].mass(), approaching()[1].mass());
  return hertz_collision_time(kModulus, effective(1, 0.7), least, 2) / 100;
}

std::string text(const Vec<3>& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v[0], v[1], v[2]);
}

/// One row of nine numbers a sphere and step: place, velocity, spin.
std::vector<std::vector<Ball>> lammps(const fs::path& folder) {
  const std::vector<Ball> balls = approaching();
  std::string data = "two spheres\n\n2 atoms\n1 atom types\n0 10 xlo xhi\n0 10 ylo yhi\n0 10 zlo zhi\n\nAtoms # "
                     "sphere\n\n";
  std::string velocities = "\nVelocities # sphere\n\n";
  for (std::size_t i = 0; i < balls.size(); ++i) {
    data += fmt::format("{} 1 {:.17g} 1 {}\n", i + 1, 2 * balls[i].radius, text(balls[i].centre));
    velocities += fmt::format("{} {} {}\n", i + 1, text(balls[i].velocity), text(balls[i].spin));
  }
  write_atomically(folder / "two.data", data + velocities);
  write_atomically(
      folder / "in.two",
      fmt::format("units si\natom_style sphere\nboundary f f f\nnewton off\ncomm_modify vel yes\nread_data two.data\n"
                  "pair_style granular\npair_coeff * * hertz/material {:.17g} {:.17g} {} tangential mindlin NULL 1.0 "
                  "{} damping tsuji\nneigh_modify delay 0 every 1 check yes\nfix motion all nve/sphere\ntimestep "
                  "{:.17g}\ndump path all custom 1 path.txt x y z vx vy vz omegax omegay omegaz\ndump_modify path "
                  "sort id format float %.17g\nrun {}\n",
                  2 * (1 - kPoisson * kPoisson) * kModulus, lammps_restitution(damping_of_restitution(kRestitution)),
                  kPoisson, kFriction, step(), kSteps));
  const std::string command = fmt::format("cd '{}' && exec lmp -in in.two", folder.string());
  const ProcessResult run = run_process({.argv = {"sh", "-c", command}, .log = folder / "log"});
  INFO(run.log_tail);
  REQUIRE(run.succeeded());
  std::vector<std::vector<Ball>> path;
  std::istringstream lines(read_file(folder / "path.txt"));
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("ITEM: ATOMS", 0) != 0)
      continue;
    std::vector<Ball> now = balls;
    for (Ball& b : now) {
      for (Vec<3>* v : {&b.centre, &b.velocity, &b.spin})
        lines >> (*v)[0] >> (*v)[1] >> (*v)[2];
    }
    path.push_back(now);
  }
  return path;
}

} // namespace

TEST_CASE("two spheres collide as in LAMMPS, step by step") {
  if (run_process({.argv = {"sh", "-c", "command -v lmp"}}).code != 0) {
    WARN("skipped: lmp is not installed");
    return;
  }
  const fs::path folder = fs::temp_directory_path() / fmt::format("tamp-collision-{}", ::getpid());
  fs::create_directories(folder);
  const auto path = lammps(folder);
  fs::remove_all(folder);
  REQUIRE(path.size() == kSteps + 1);

  using Law = ContactLaw<Hertz, TsujiDamping, Mindlin>;
  const Elastic solid{2 * (1 - kPoisson * kPoisson) * kModulus, kPoisson};
  const Law law{
      {kModulus}, {damping_of_restitution(kRestitution)}, {effective_shear_modulus(solid, solid), kFriction, 1}};
  const std::vector<Ball> balls = approaching();
  State<3, Law> state = at_rest<3, Law>({balls[0].centre, balls[1].centre}, {balls[0].radius, balls[1].radius},
                                        {balls[0].mass(), balls[1].mass()}, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    state.velocity[i] = balls[i].velocity;
    state.spin[i] = balls[i].spin;
  }
  SearchBox<3> box;
  box.size = Vec<3>::Constant(10);
  ForceField<3, Law> field(law, box, 0.3);
  const double dt = step();
  field.evaluate(state, 0);
  double worst = 0;
  for (const auto& theirs : path) {
    for (std::size_t i = 0; i < 2; ++i) {
      worst = std::max({worst, (state.centre[i] - theirs[i].centre).norm(),
                        (state.velocity[i] - theirs[i].velocity).norm(), (state.spin[i] - theirs[i].spin).norm()});
    }
    verlet_step(state, field, dt);
  }
  CHECK(worst < kAgreement);
  CHECK((state.velocity[0] - state.velocity[1]).norm() < 1.9); // they have met, and bounced
  CHECK((state.velocity[0] - state.velocity[1]).dot(state.centre[0] - state.centre[1]) > 0);
  CHECK((state.spin[1] - balls[1].spin).norm() > 0.1);
}
