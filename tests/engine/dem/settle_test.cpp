// Beds settle to rest: force balance, weight on the floor, threads, checkpoints, the watch over the step.
#include "engine/dem/settle_run.h"
#include "tests/engine/dem/clouds.h"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

using namespace tamp;
using namespace tamp::test;

namespace {

constexpr ContactEffects kFrictionless{};
constexpr ContactEffects kFrictional{AdhesionLaw::none, true};

/// Bounds of a settled bed: inside the box, no deeper overlap than stated, found by trying all pairs.
template <int D>
void check_bed(const SettleTask<D>& task, const Settled<D>& bed) {
  REQUIRE(bed.at_rest);
  CHECK(bed.overlap <= task.overlap);
  double deepest = 0;
  for (std::size_t i = 0; i < bed.centres.size(); ++i) {
    for (int a = 0; a < D; ++a) {
      if (task.box.periodic[static_cast<std::size_t>(a)])
        continue;
      deepest = std::max(deepest, 1 - bed.centres[i][a] / task.radii[i]);
      if (a != vertical<D>)
        deepest = std::max(deepest, 1 - (task.box.size[a] - bed.centres[i][a]) / task.radii[i]);
    }
    for (std::size_t j = 0; j < i; ++j) {
      Vec<D> apart = bed.centres[i] - bed.centres[j];
      for (int a = 0; a < D; ++a) {
        if (task.box.periodic[static_cast<std::size_t>(a)])
          apart[a] -= task.box.size[a] * std::round(apart[a] / task.box.size[a]);
      }
      deepest =
          std::max(deepest, (task.radii[i] + task.radii[j] - apart.norm()) / std::min(task.radii[i], task.radii[j]));
    }
  }
  CHECK(bed.overlap == Approx(deepest).margin(1e-12));
}

} // namespace

TEMPLATE_TEST_CASE_SIG("clouds settle to force balance, with and without friction, walls and periodic sides",
                       "[settle]", ((int D), D), 2, 3) {
  for (const bool periodic : {false, true}) {
    for (const ContactEffects& effects : {kFrictionless, kFrictional}) {
      SettleTask<D> task = cloud<D>(D == 2 ? 120 : 100, D == 2 ? 10 : 4, 0.5, periodic, "settle");
      task.effects = effects;
      task.friction = 0.5;
      const Settled<D> bed = settle(task);
      check_bed(task, bed);
      CHECK(bed.halvings == 0);
    }
  }
}

TEST_CASE("one and two threads give the same bits, with friction and without", "[settle]") {
  for (const ContactEffects& effects : {kFrictionless, kFrictional}) {
    SettleTask<3> task = cloud<3>(4200, 22, 0.5, true, "threads");
    task.effects = effects;
    task.friction = 0.5;
    task.modulus = task.largest_modulus = 2e3;
    task.force_balance = 0.05;
    task.longest = 0.6; // not settled: enough to have thousands of contacts
    const auto with_threads = [&](std::size_t threads) {
      const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
      return settle(task);
    };
    const Settled<3> one = with_threads(1);
    CHECK(one.overlap > 0);
    CHECK(one.steps >= 500); // with thousands of contacts
    CHECK(same_bits(one, with_threads(2)));
  }
}

TEST_CASE("a run that was cut off ends as one that was not", "[settle]") {
  const auto folder = std::filesystem::temp_directory_path() / ("tamp-settle-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const ContactEffects& effects : {kFrictionless, kFrictional, ContactEffects{AdhesionLaw::jkr, true}}) {
    SettleTask<3> task = cloud<3>(60, 3, 0.7, true, "resume");
    task.effects = effects;
    task.friction = 0.5;
    task.adhesion = 0.2;
    task.modulus = 1e4;
    task.largest_modulus = 1e6;
    task.overlap = 0.01; // stiffened on the way
    int looks_of_a_life = 3;
    if (effects == kFrictionless) { // looked at five times less often, and sooner at rest
      task.overlap = 1e-4;
      task.largest_modulus = 1e12;
      looks_of_a_life = 2;
    }
    const Settled<3> whole = settle(task);
    REQUIRE(whole.at_rest);
    CHECK(whole.stiffenings > 0);
    task.checkpoint = folder / "state";
    task.checkpoint_every_s = 0;
    std::filesystem::remove(task.checkpoint);
    // Cut off again and again, a little later each time.
    struct Killed {};
    int looks = 0;
    for (int life = 1; life <= 5; ++life) {
      task.progress = [&](double) {
        if (++looks % looks_of_a_life == 0)
          throw Killed{};
      };
      CHECK_THROWS_AS(settle(task), Killed);
    }
    task.progress = {};
    const Settled<3> resumed = settle(task);
    CHECK(same_bits(whole, resumed));
    CHECK(resumed.stiffenings == whole.stiffenings);
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("a checkpoint of something else is not gone on from", "[settle]") {
  const auto file = std::filesystem::temp_directory_path() / ("tamp-settle-other-" + std::to_string(::getpid()));
  SettleTask<3> task = cloud<3>(30, 3, 0.7, true, "other");
  const Settled<3> whole = settle(task);
  for (const std::string& bytes : {std::string(), std::string("short"), std::string(5000, 'x')}) {
    write_atomically(file, bytes);
    task.checkpoint = file;
    CHECK(same_bits(whole, settle(task)));
  }
  std::filesystem::remove(file);
}

TEST_CASE("a step that is too long is noticed, halved and redone, and the bed settles all the same", "[watch]") {
  SettleTask<3> task = cloud<3>(100, 4, 0.5, true, "watch");
  task.effects = kFrictional;
  task.friction = 0.5;
  task.steps_per_collision = 0.7;
  const Settled<3> bed = settle(task);
  CHECK(bed.halvings > 0);
  CHECK(bed.halvings <= 5);
  check_bed(task, bed);
}

TEST_CASE("contacts too soft for the tolerated overlap are stiffened until they are not", "[settle]") {
  SettleTask<3> task = cloud<3>(150, 4, 0.5, true, "stiffen");
  task.overlap = 2e-3;
  task.largest_modulus = 1e9;
  const Settled<3> bed = settle(task);
  CHECK(bed.stiffenings > 0);
  CHECK(bed.modulus > task.modulus);
  check_bed(task, bed);
  // At a stiffness that may not rise the bed is left as it is, and says so.
  task.largest_modulus = task.modulus;
  const Settled<3> soft = settle(task);
  CHECK(soft.at_rest);
  CHECK(soft.overlap > task.overlap);
}

namespace {

template <class Law>
Settled<3> settle_with(const SettleTask<3>& task, const Law& law) {
  return SettleRun<3, Law>(task, [law](double) { return law; }).run();
}

} // namespace

TEST_CASE("the full kernel with zeros gives what the kernel of the scene gives", "[effects]") {
  SettleTask<3> task = cloud<3>(60, 3, 0.5, true, "zeros");
  const TsujiDamping damping{damping_of_restitution(task.restitution)};
  const Settled<3> own = settle_with(task, ContactLaw<Hertz, TsujiDamping>{{task.modulus}, damping});
  REQUIRE(own.at_rest);
  const Mindlin no_friction{task.modulus / 100, 0, 1}; // so soft that inertia is matched to Hertz's stiffness alone
  const RollingSpring no_rolling{1, 0, 0};
  using WithDmt = ContactLaw<Dmt, TsujiDamping, Mindlin, RollingSpring>;
  const Settled<3> dmt = settle_with(task, WithDmt{{task.modulus, 0}, damping, no_friction, no_rolling});
  CHECK(same_bits(own, dmt));
  // JKR finds the contact radius by another way, whose rounding many collisions magnify: up to the first ones.
  task.longest = 0.8;
  using WithJkr = ContactLaw<Jkr, TsujiDamping, Mindlin, RollingSpring>;
  const Settled<3> brief = settle_with(task, ContactLaw<Hertz, TsujiDamping>{{task.modulus}, damping});
  const Settled<3> jkr = settle_with(task, WithJkr{{task.modulus, 0}, damping, no_friction, no_rolling});
  REQUIRE(brief.overlap > 0);
  for (std::size_t i = 0; i < task.radii.size(); ++i)
    CHECK((brief.centres[i] - jkr.centres[i]).norm() < 1e-6);
}

TEST_CASE("friction leaves a bed looser, adhesion looser still", "[settle][slow]") {
  SettleTask<3> task = cloud<3>(400, 5, 0.9, true, "looser");
  const auto height = [&](const ContactEffects& effects) {
    task.effects = effects;
    task.friction = 0.5;
    task.adhesion = 20; // pull-off forces of some twenty times the weight
    const Settled<3> bed = settle(task);
    CHECK(bed.at_rest);
    double sum = 0;
    for (const Vec<3>& c : bed.centres)
      sum += c[2];
    return sum / static_cast<double>(bed.centres.size());
  };
  const double smooth = height(kFrictionless);
  const double rough = height(kFrictional);
  const double sticky = height({AdhesionLaw::dmt, true});
  CHECK(rough > 1.02 * smooth);
  CHECK(sticky > 1.02 * rough);
}

TEST_CASE("a bed of sizes far apart comes to rest with friction", "[settle][slow]") {
  SettleTask<3> task = cloud<3>(400, 6, 0.05, true, "sizes");
  task.effects = kFrictional;
  task.friction = 0.5;
  task.modulus = 1e5;
  task.largest_modulus = 1e12;
  task.overlap = 2e-3;
  check_bed(task, settle(task));
}

TEST_CASE("a sphere that friction holds wedged between two images of another is given up as it is", "[settle]") {
  SettleTask<3> task;
  task.box.size = Vec<3>(12.2, 12, 60);
  task.box.periodic = {true, true, false};
  task.box.wall[2] = {true, false};
  task.centres = {{0, 6, 4.4}, {6.1, 6, 40}};
  task.radii = {4.39, 1.96};
  for (const double r : task.radii)
    task.masses.push_back(4.0 / 3.0 * std::numbers::pi * r * r * r);
  task.effects = kFrictional;
  task.friction = 0.577;
  task.modulus = 1e5;
  task.largest_modulus = 1e12;
  task.overlap = 1e-3;
  const Settled<3> bed = settle(task);
  CHECK(bed.at_rest);
  CHECK(bed.overlap > task.overlap);
  CHECK(bed.stiffenings <= 12);
}
