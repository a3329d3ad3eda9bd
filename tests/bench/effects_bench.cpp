// What it saves to simulate only the effects that a scene calls for: beds without friction and adhesion, settled by
// kernels that know more and more effects, all of them with parameters of zero, and by the minimiser that such scenes
// get. One thread, one run, ratios of CPU time. Checks its answers too: the kernels must give the same bed.
#include "engine/base/host.h"
#include "engine/base/random.h"
#include "engine/dem/settle_run.h"
#include "engine/generate/loose_cloud.h"

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <numbers>

namespace {

using namespace tamp;

/// JKR finds a contact's radius by another way than Hertz, so bits differ and beds of many collisions part: their mean
/// heights agree within this share.
constexpr double kSameHeight = 5e-3;
/// A minimised bed and one that came to rest in time.
constexpr double kSameHeightAtRest = 0.02;

// Units in which the mean radius, the density and gravity are 1.
SettleTask<3> bed_of_equal_spheres(std::size_t n, double edge) {
  SettleTask<3> task;
  task.box.size = {edge, edge, 1};
  task.box.periodic = {true, true, false};
  task.box.wall[2] = {true, false};
  const auto cloud =
      loose_cloud<3>(task.box.size, task.box.periodic, std::vector<double>(n, 1.0), 0.3, RandomStream("effects", 0));
  task.centres = cloud.centres;
  task.radii = cloud.radii;
  task.masses.assign(n, 4.0 / 3.0 * std::numbers::pi);
  task.overlap = 1e-2;
  task.force_balance = 5e-3;
  task.kinetic_energy = 1e-4;
  task.modulus = 1e4;
  task.largest_modulus = 1e12;
  return task;
}

struct Timed {
  Settled<3> bed;
  double cpu_s;
  double height; // mean, of the centres
};

template <class Run>
Timed timed(const Run& run) {
  const double start = thread_cpu_seconds();
  Timed result{run(), 0, 0};
  result.cpu_s = thread_cpu_seconds() - start;
  for (const Vec<3>& c : result.bed.centres)
    result.height += c[2] / static_cast<double>(result.bed.centres.size());
  return result;
}

template <class Law, class... Effects>
Timed by_kernel(const SettleTask<3>& task, Effects... effects) {
  return timed([&] {
    const auto law = [&](double modulus) {
      const TsujiDamping damping{damping_of_restitution(task.restitution)};
      if constexpr (std::is_same_v<decltype(Law::normal), Hertz>)
        return Law{{modulus}, damping, effects...};
      else
        return Law{{modulus, 0}, damping, effects...};
    };
    return SettleRun<3, Law>(task, law).run();
  });
}

bool same_bits(const Timed& a, const Timed& b) {
  return std::memcmp(a.bed.centres.data(), b.bed.centres.data(), a.bed.centres.size() * sizeof(Vec<3>)) == 0;
}

bool same_height(const Timed& a, const Timed& b, double share) {
  return std::abs(a.height / b.height - 1) < share;
}

void left_out(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto task = bed_of_equal_spheres(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1)));
  // So soft that inertia is matched to the stiffness of Hertz's contacts alone.
  const Mindlin no_friction{task.modulus / 100, 0, 1};
  const RollingSpring no_rolling{1, 0, 0};
  for ([[maybe_unused]] auto _ : state) {
    const Timed minimised = timed([&] { return settle(task); });
    const Timed own = by_kernel<ContactLaw<Hertz, TsujiDamping>>(task);
    const Timed dmt = by_kernel<ContactLaw<Dmt, TsujiDamping>>(task);
    const Timed friction = by_kernel<ContactLaw<Hertz, TsujiDamping, Mindlin>>(task, no_friction);
    const Timed rolling =
        by_kernel<ContactLaw<Hertz, TsujiDamping, Mindlin, RollingSpring>>(task, no_friction, no_rolling);
    const Timed all = by_kernel<ContactLaw<Jkr, TsujiDamping, Mindlin, RollingSpring>>(task, no_friction, no_rolling);
    for (const Timed* same : {&dmt, &friction, &rolling}) {
      if (!same_bits(own, *same))
        return state.SkipWithError("a kernel with zeros gives another bed");
    }
    if (!same_height(own, all, kSameHeight) || !same_height(own, minimised, kSameHeightAtRest))
      return state.SkipWithError("the beds have different heights");
    const auto per_step = [](const Timed& t) { return t.cpu_s / static_cast<double>(t.bed.steps); };
    state.counters["own_cpu_s"] = own.cpu_s;
    state.counters["steps"] = static_cast<double>(own.bed.steps);
    state.counters["dmt_over_own"] = per_step(dmt) / per_step(own);
    state.counters["friction_over_own"] = per_step(friction) / per_step(own);
    state.counters["rolling_over_own"] = per_step(rolling) / per_step(own);
    state.counters["all_over_own"] = per_step(all) / per_step(own);
    state.counters["own_over_minimiser"] = own.cpu_s / minimised.cpu_s;
    state.counters["all_over_minimiser"] = all.cpu_s / minimised.cpu_s;
  }
}

} // namespace

BENCHMARK(left_out)->Args({1000, 16})->Iterations(1)->Repetitions(3)->Unit(benchmark::kSecond);
