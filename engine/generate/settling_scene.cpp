// Spheres drawn or taken over, placed, and turned into a settling task.
#include "engine/generate/settling_scene.h"

#include "engine/contact/hertz.h"
#include "engine/contact/spin.h"
#include "engine/dem/time_step.h"
#include "engine/generate/material_effects.h"
#include "engine/generate/radius_sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tamp {

namespace {

/// Contacts start as soft as an overlap of this many times the tolerated one allows, and are stiffened once the bed
/// rests: most of the time goes into the fall, where stiffness only shortens the step.
constexpr double kSoftStart = 20;
/// Where energy is minimised, contacts start so soft that this overlap is expected.
constexpr double kSoftBed = 0.1;
/// The largest contact force of a bed in units of the weight of a column of spheres: force chains.
constexpr double kForceChain = 4;

// Campaigns state the number that the stability of the step was judged by.
static_assert(DemGravity{}.steps_per_collision == kStepsPerCollision);

BedUnits bed_units(const std::vector<double>& radii, LengthUnit unit, const Method& method) {
  BedUnits units;
  units.length = std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
  units.metre = units.length * metres(unit);
  units.pressure = method.material.density * method.dem_gravity.gravity * units.metre;
  units.time = std::sqrt(units.metre / method.dem_gravity.gravity);
  return units;
}

/// E* at which a Hertz contact bears the largest forces to be expected with kSoftStart times the tolerated overlap.
template <int D>
double soft_modulus(const SettleTask<D>& task, bool moves) {
  double volume = 0; // of the column above the floor, filled as a bed is
  double mass = 0;
  for (std::size_t i = 0; i < task.radii.size(); ++i) {
    const double r = task.radii[i];
    volume += D == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r;
    mass += task.masses[i] / static_cast<double>(task.radii.size());
  }
  const double height = volume / (kGuessedPhi * task.box.size.template head<vertical<D>>().prod());
  const double chain = kForceChain * mass * std::max(1.0, height / 2);
  const double smallest = *std::min_element(task.radii.begin(), task.radii.end());
  const double tolerated = std::max(moves ? std::min(kSoftStart * task.overlap, kSoftBed) : kSoftBed, task.overlap);
  // F = 4/3 E* √R δ^{3/2} with R = r/2 and δ = tolerated · r: of the mean radius (1) under weight, of the smallest
  // under its own pull-off force 2πWR.
  return std::max(hertz_modulus(chain, 0.5, tolerated),
                  hertz_modulus(std::numbers::pi * task.adhesion * smallest, 0.5 * smallest, tolerated * smallest));
}

} // namespace

template <int D>
SettlingScene<D>::SettlingScene(const Request& request) {
  const Scene& scene = request.job.scene;
  const Method& method = request.job.method;
  if (request.parent != nullptr) {
    const Packing& parent = *request.parent;
    if (parent.dimension != D) {
      obstacle = "the packing to start from has another dimension than the scene";
      return;
    }
    unit = parent.unit;
    cloud.radii = parent.radii;
    for (std::size_t i = 0; i < parent.count(); ++i)
      cloud.centres.push_back(parent.centre<D>(i));
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      size[a] = parent.size[n];
      periodic[n] = a != vertical<D> && parent.boundary[n] == Boundary::periodic;
    }
  } else {
    unit = scene.unit;
    for (int a = 0; a < D; ++a) {
      size[a] = scene.size[static_cast<std::size_t>(a)];
      periodic[static_cast<std::size_t>(a)] = a != vertical<D> && scene.sides == Sides::periodic;
    }
    const SizeLaw law(scene.psd, D);
    const double wanted =
        scene.count > 0 ? static_cast<double>(scene.count) : std::max(1.0, full_box_count(scene, law));
    cloud.radii = draw_radii(law, scene.sampler, static_cast<std::size_t>(wanted),
                             RandomStream(request.key, static_cast<std::uint64_t>(Stream::radii)));
  }
  if (cloud.radii.empty()) {
    obstacle = "there are no spheres to settle";
    return;
  }
  const double widest = 2 * *std::max_element(cloud.radii.begin(), cloud.radii.end());
  if (!(widest < size.template head<vertical<D>>().minCoeff())) {
    obstacle = fmt::format("the largest sphere, {:g} wide, does not fit between the sides", widest);
    return;
  }
  if (request.parent == nullptr)
    cloud = loose_cloud<D>(size, periodic, std::move(cloud.radii), method.dem_gravity.cloud_phi,
                           RandomStream(request.key, static_cast<std::uint64_t>(Stream::positions)));
  units = bed_units(cloud.radii, unit, method);
}

template <int D>
SettleTask<D> SettlingScene<D>::task(const Request& request, bool always_in_time) {
  const Material& material = request.job.method.material;
  const DemGravity& gravity = request.job.method.dem_gravity;
  SettleTask<D> task;
  task.box.size = size / units.length;
  task.box.periodic = periodic;
  for (int a = 0; a < D; ++a)
    task.box.wall[static_cast<std::size_t>(a)] = {true, a != vertical<D>};
  const bool disc = D == 2 && gravity.flat_body == FlatBody::disc;
  for (std::size_t i = 0; i < cloud.radii.size(); ++i) {
    const double r = cloud.radii[i] / units.length;
    task.centres.push_back(cloud.centres[i] / units.length);
    task.radii.push_back(r);
    // A disc weighs as a slice one mean radius thick; that counts only against adhesion.
    task.masses.push_back(disc ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r);
  }
  task.gyration = disc ? gyration<2> : gyration<3>;
  task.poisson = material.poisson;
  task.friction = material.friction;
  task.restitution = material.restitution;
  task.adhesion = material.adhesion / (units.pressure * units.metre);
  task.overlap = gravity.overlap;
  task.force_balance = gravity.force_balance;
  task.kinetic_energy = gravity.kinetic_energy;
  task.steps_per_collision = gravity.steps_per_collision;
  task.checkpoint = request.checkpoint;
  if (request.progress) {
    const auto n = static_cast<double>(cloud.radii.size());
    task.progress = [report = request.progress, n](double share) { report(static_cast<std::size_t>(share * n)); };
  }

  const double hard = hard_modulus(material);
  tabor = tabor_of(material, units.metre);
  task.effects = effects_of(material, tabor);
  task.minimise = !moves_in_time(material);
  task.largest_modulus = hard / units.pressure;
  task.modulus = std::min(task.largest_modulus, soft_modulus(task, always_in_time || !task.minimise));
  return task;
}

template <int D>
Packing SettlingScene<D>::packing(std::span<const Vec<D>> centres) const {
  Packing packing;
  packing.dimension = D;
  packing.unit = unit;
  packing.radii = cloud.radii;
  for (int a = 0; a < D; ++a) {
    const auto n = static_cast<std::size_t>(a);
    packing.size[n] = size[a];
    packing.boundary[n] = a == vertical<D> ? Boundary::open : periodic[n] ? Boundary::periodic : Boundary::wall;
  }
  for (const Vec<D>& settled : centres) {
    Vec<D> c = settled * units.length;
    for (int a = 0; a < D; ++a) {
      if (periodic[static_cast<std::size_t>(a)])
        c[a] -= std::floor(c[a] / size[a]) * size[a];
    }
    packing.positions.insert(packing.positions.end(), c.data(), c.data() + D);
  }
  return packing;
}

template struct SettlingScene<2>;
template struct SettlingScene<3>;

} // namespace tamp
