// Campaigns with invented records and packings, one that gives each kind of figure its numbers.
#pragma once

#include "report/figures/make_figures.h"
#include "tests/report/synthetic_campaign.h"

#include <cmath>

namespace tamp::test {

/// A packing of 2 × 2 (× 2) touching spheres with four radii, in a box of edge 4.
inline Packing small_packing(int dimension, Boundary boundary = Boundary::wall) {
  Packing packing;
  packing.dimension = dimension;
  for (int axis = 0; axis < dimension; ++axis) {
    packing.size[static_cast<std::size_t>(axis)] = 4;
    packing.boundary[static_cast<std::size_t>(axis)] = boundary;
  }
  for (int i = 0; i < 1 << dimension; ++i) {
    for (int axis = 0; axis < dimension; ++axis)
      packing.positions.push_back((i >> axis & 1) != 0 ? 3 : 1);
    packing.radii.push_back(1.0 / (1 << i % 4));
  }
  return packing;
}

/// Adds a job with its measures; metrics need no records for figures.
inline void add_measured(SyntheticCampaign& campaign, const Job& job, const std::string& label,
                         const std::vector<Measure>& measures, double seconds) {
  PlannedJob planned;
  planned.job = job;
  planned.key = job_key(job);
  planned.label = label;
  planned.point["scene/size"] = std::to_string(job.scene.size.front());
  campaign.plan.jobs.push_back(planned);
  Record& record = campaign.add_record(planned.key, JobKind::generation, std::string(name_of(job.method.name)));
  record.measures = measures;
  record.timing = {TimingMode::exclusive, seconds, seconds, seconds, seconds, 1};
  record.packing_file = "packings/" + planned.key;
}

inline Job bimodal_job(double size_ratio, double large_fraction) {
  Job job;
  job.scene.size = {50};
  job.scene.psd.law = Law::bimodal;
  job.scene.psd.small_radius = 1;
  job.scene.psd.size_ratio = size_ratio;
  job.scene.psd.large_volume_fraction = large_fraction;
  job.scene = completed(job.scene);
  return job;
}

/// Numbers for every kind of figure.
inline SyntheticCampaign everything() {
  SyntheticCampaign campaign;
  for (const double ratio : {1.0, 2.0, 5.0})
    for (const double fraction : {0.0, 0.5, 0.75, 1.0})
      for (int replicate = 0; replicate < 2; ++replicate) {
        Job job = bimodal_job(ratio, fraction);
        job.replicate = replicate;
        add_measured(campaign, job, "D&R", {{"N", 1000}, {"phi", 0.6 + 0.01 * ratio}, {"X_L", 0.9 * fraction}}, 1);
      }
  for (const double edge : {40.0, 60.0, 80.0, 120.0}) {
    for (int replicate = 0; replicate < 2; ++replicate) {
      for (const bool dem : {false, true}) {
        Job job;
        job.scene = paper_scene(3);
        job.scene.size = {edge, edge, edge};
        job.scene.psd.r_max = 20;
        job.replicate = replicate;
        job.method.name = dem ? MethodName::dem_isostatic : MethodName::drop_and_roll;
        const double count = edge * edge * edge / 50 + replicate;
        add_measured(campaign, job, dem ? "'isostatic' {x}_^" : "D&R",
                     {{"N", count},
                      {"phi", 0.6 + 1 / edge + 0.001 * replicate},
                      {"H_N", 4 / edge},
                      {"H_N_floor", 2 / edge},
                      {"H_V", 8 / edge},
                      {"H_V_floor", 5 / edge}},
                     1e-4 * std::pow(count, 1.1));
      }
    }
  }
  for (const double friction : {0.0, 0.5})
    for (const double adhesion : {0.0, 1e-3, 1e-1}) {
      Job job;
      job.scene = paper_scene(3);
      job.method.name = MethodName::dem_gravity;
      job.method.material.friction = friction;
      job.method.material.adhesion = adhesion;
      add_measured(campaign, job, "gravity", {{"N", 1000}, {"phi", 0.6 - 0.1 * friction - adhesion}}, 100);
    }
  for (const double rate : {0.04, 0.02, 0.01, 0.005})
    for (int replicate = 0; replicate < 2; ++replicate) {
      Job job;
      job.scene = paper_scene(3);
      job.replicate = replicate;
      job.method.name = MethodName::dem_isostatic;
      job.method.dem_isostatic.rate = rate;
      add_measured(campaign, job, "rates", {{"N", 1000}, {"phi", 0.64 - rate + 1e-4 * replicate}}, 1 / rate);
    }
  return campaign;
}

inline ReportFigures figures_of(const SyntheticCampaign& campaign, const std::string& gnuplot = "gnuplot") {
  FigureSettings settings{true, [](const std::string&) { return small_packing(3); }, gnuplot, 60};
  return make_figures(campaign.runs(), "tamp run synthetic.json", settings);
}

} // namespace tamp::test
