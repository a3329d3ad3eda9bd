// Drop-and-roll against a yardstick that holds on any machine: CGAL's Delaunay triangulation of the same centres, timed
// in turns with it in one run. Checks its answer too: a packing with an overlap makes the benchmark fail.
#include "engine/base/host.h"
#include "engine/generate/generator.h"
#include "engine/measure/measure.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>
#include <vector>

namespace {

using namespace tamp;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Rounds of generator and triangulation in turns; the medians of the ratios are reported.
constexpr int kRounds = 5;

Job base_job(std::int64_t dimension, double edge) {
  Job job;
  job.scene.dimension = dimension;
  job.scene.size.assign(static_cast<std::size_t>(dimension), edge);
  return job;
}

/// The benchmark's powder, in micrometres.
Job lognormal(std::int64_t dimension, double edge) {
  Job job = base_job(dimension, edge);
  job.scene.psd.law = Law::lognormal;
  job.scene.psd.mu_ln = 0.30;
  job.scene.psd.sigma_ln = 0.68;
  job.scene.psd.r_min = 0.1;
  job.scene.psd.r_max = 50;
  return job;
}

Job monodisperse(double edge) {
  Job job = base_job(3, edge);
  job.scene.psd.law = Law::monodisperse;
  job.scene.psd.radius = 1;
  return job;
}

double triangulate(const Packing& packing) {
  const double start = thread_cpu_seconds();
  if (packing.dimension == 2) {
    std::vector<Kernel::Point_2> points;
    for (std::size_t i = 0; i < packing.count(); ++i)
      points.emplace_back(packing.centre<2>(i)[0], packing.centre<2>(i)[1]);
    const CGAL::Delaunay_triangulation_2<Kernel> triangulation(points.begin(), points.end());
    benchmark::DoNotOptimize(triangulation.number_of_vertices());
  } else {
    std::vector<Kernel::Point_3> points;
    for (std::size_t i = 0; i < packing.count(); ++i) {
      const auto c = packing.centre<3>(i);
      points.emplace_back(c[0], c[1], c[2]);
    }
    const CGAL::Delaunay_triangulation_3<Kernel> triangulation(points.begin(), points.end());
    benchmark::DoNotOptimize(triangulation.number_of_vertices());
  }
  return thread_cpu_seconds() - start;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// paper_s: the paper's time for the same case, on its own machine.
void drop_and_roll(benchmark::State& state, const Job& job, double paper_s) {
  std::vector<double> times;
  std::vector<double> ratios;
  Generated out;
  for ([[maybe_unused]] auto _ : state) {
    for (int round = 0; round < kRounds; ++round) {
      const double start = thread_cpu_seconds();
      out = generate({job, "bench " + std::to_string(round)});
      times.push_back(thread_cpu_seconds() - start);
      ratios.push_back(times.back() / triangulate(out.packing));
    }
  }
  Metric overlap;
  overlap.name = MetricName::overlap;
  if (measure(overlap, out.packing, job.scene).front().value > 1e-10)
    return state.SkipWithError("the packing overlaps");
  const auto n = static_cast<double>(out.packing.count());
  state.counters["N"] = n;
  state.counters["cpu_s"] = median(times);
  state.counters["us_per_sphere"] = 1e6 * median(times) / n;
  state.counters["over_Delaunay"] = median(ratios);
  if (paper_s > 0)
    state.counters["paper_over_this"] = paper_s / median(times);
}

} // namespace

BENCHMARK_CAPTURE(drop_and_roll, lognormal_2d_600um, lognormal(2, 600), 4.65)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(drop_and_roll, lognormal_3d_133um, lognormal(3, 133), 26)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(drop_and_roll, monodisperse_3d, monodisperse(61), 5)->Iterations(1)->Unit(benchmark::kSecond);
