// From a job to a settling task in units of the bed, and from the settled bed to a packing.
#include "engine/generate/dem_gravity.h"

#include "engine/contact/spin.h"
#include "engine/contact/tabor.h"
#include "engine/dem/settle.h"
#include "engine/generate/loose_cloud.h"
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
constexpr double kSoftStart = 4;
/// The largest contact force of a bed in units of the weight of a column of spheres: force chains.
constexpr double kForceChain = 4;

double metres(LengthUnit unit) {
  switch (unit) {
  case LengthUnit::nm:
    return 1e-9;
  case LengthUnit::um:
    return 1e-6;
  case LengthUnit::mm:
    return 1e-3;
  case LengthUnit::m:
    break;
  }
  return 1;
}

/// Units in which the mean radius, the density and gravity are 1.
struct Units {
  double length; ///< in the scene's unit
  double metre;  ///< of that, in metres
  double pressure;
  double time;

  Units(double mean_radius, LengthUnit unit, const Method& method)
      : length(mean_radius), metre(mean_radius * metres(unit)),
        pressure(method.material.density * method.dem_gravity.gravity * metre),
        time(std::sqrt(metre / method.dem_gravity.gravity)) {}
};

template <int D>
class DemGravityRun {
public:
  explicit DemGravityRun(const Request& request) : request_(request), method_(request.job.method) {}

  Generated run() {
    if (std::string reason = set_out(); !reason.empty()) {
      Generated out;
      out.outcome = Outcome::not_applicable;
      out.reason = std::move(reason);
      return out;
    }
    const Units units(mean(cloud_.radii), unit_, method_);
    const SettleTask<D> task = task_in(units);
    return result(units, task, settle(task));
  }

private:
  static double mean(const std::vector<double>& radii) {
    return std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
  }

  /// Box and spheres to start from, in the scene's unit; the reason if there can be none.
  std::string set_out() {
    const Scene& scene = request_.job.scene;
    if (request_.parent != nullptr) {
      const Packing& parent = *request_.parent;
      if (parent.dimension != D)
        return "the packing to start from has another dimension than the scene";
      unit_ = parent.unit;
      cloud_.radii = parent.radii;
      for (std::size_t i = 0; i < parent.count(); ++i)
        cloud_.centres.push_back(parent.centre<D>(i));
      for (int a = 0; a < D; ++a) {
        const auto n = static_cast<std::size_t>(a);
        size_[a] = parent.size[n];
        periodic_[n] = a != vertical<D> && parent.boundary[n] == Boundary::periodic;
      }
    } else {
      unit_ = scene.unit;
      for (int a = 0; a < D; ++a) {
        size_[a] = scene.size[static_cast<std::size_t>(a)];
        periodic_[static_cast<std::size_t>(a)] = a != vertical<D> && scene.sides == Sides::periodic;
      }
      const SizeLaw law(scene.psd, D);
      const double wanted =
          scene.count > 0 ? static_cast<double>(scene.count) : std::max(1.0, full_box_count(scene, law));
      cloud_.radii = draw_radii(law, scene.sampler, static_cast<std::size_t>(wanted),
                                RandomStream(request_.key, static_cast<std::uint64_t>(Stream::radii)));
    }
    if (cloud_.radii.empty())
      return "there are no spheres to settle";
    const double widest = 2 * *std::max_element(cloud_.radii.begin(), cloud_.radii.end());
    if (!(widest < size_.template head<vertical<D>>().minCoeff()))
      return fmt::format("the largest sphere, {:g} wide, does not fit between the sides", widest);
    if (request_.parent == nullptr)
      cloud_ = loose_cloud<D>(size_, periodic_, std::move(cloud_.radii), method_.dem_gravity.cloud_phi,
                              RandomStream(request_.key, static_cast<std::uint64_t>(Stream::positions)));
    return {};
  }

  SettleTask<D> task_in(const Units& units) {
    const Material& material = method_.material;
    const DemGravity& gravity = method_.dem_gravity;
    SettleTask<D> task;
    task.box.size = size_ / units.length;
    task.box.periodic = periodic_;
    for (int a = 0; a < D; ++a)
      task.box.wall[static_cast<std::size_t>(a)] = {true, a != vertical<D>};
    const bool disc = D == 2 && gravity.flat_body == FlatBody::disc;
    for (std::size_t i = 0; i < cloud_.radii.size(); ++i) {
      const double r = cloud_.radii[i] / units.length;
      task.centres.push_back(cloud_.centres[i] / units.length);
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
    task.checkpoint = request_.checkpoint;
    if (request_.progress) {
      const auto n = static_cast<double>(cloud_.radii.size());
      task.progress = [this, n](double share) { request_.progress(static_cast<std::size_t>(share * n)); };
    }

    const double hard = material.young / (2 * (1 - material.poisson * material.poisson)); // E* of two alike, Pa
    tabor_ = tabor_parameter(hard, material.adhesion, units.metre / 2, kAttractionRange);
    task.effects.friction = material.friction > 0;
    if (material.adhesion > 0) {
      const bool jkr = method_.material.adhesion_model == AdhesionModel::tabor
                           ? adheres_as_jkr(tabor_)
                           : method_.material.adhesion_model == AdhesionModel::jkr;
      task.effects.adhesion = jkr ? AdhesionLaw::jkr : AdhesionLaw::dmt;
    }
    task.largest_modulus = hard / units.pressure;
    task.modulus = std::min(task.largest_modulus, soft_modulus(task));
    return task;
  }

  /// E* at which a Hertz contact bears the largest forces to be expected with kSoftStart times the tolerated overlap.
  static double soft_modulus(const SettleTask<D>& task) {
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
    const double tolerated = kSoftStart * task.overlap;
    // F = 4/3 E* √R δ^{3/2} with R = r/2 and δ = tolerated · r: of the mean radius (1) under weight, of the smallest
    // under its own pull-off force 2πWR.
    const auto modulus = [&](double force, double r) {
      return 0.75 * force / (std::sqrt(0.5 * r) * std::pow(tolerated * r, 1.5));
    };
    return std::max(modulus(chain, 1), modulus(std::numbers::pi * task.adhesion * smallest, smallest));
  }

  Generated result(const Units& units, const SettleTask<D>& task, const Settled<D>& bed) {
    Generated out;
    Packing& packing = out.packing;
    packing.dimension = D;
    packing.unit = unit_;
    packing.radii = cloud_.radii;
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      packing.size[n] = size_[a];
      packing.boundary[n] = a == vertical<D> ? Boundary::open : periodic_[n] ? Boundary::periodic : Boundary::wall;
    }
    for (const Vec<D>& settled : bed.centres) {
      Vec<D> c = settled * units.length;
      for (int a = 0; a < D; ++a) {
        if (periodic_[static_cast<std::size_t>(a)])
          c[a] -= std::floor(c[a] / size_[a]) * size_[a];
      }
      packing.positions.insert(packing.positions.end(), c.data(), c.data() + D);
    }
    if (!bed.at_rest) {
      out.outcome = Outcome::did_not_converge;
      out.reason = fmt::format("the bed did not come to rest: net forces {:.2g} of the contact forces (limit {:.2g})",
                               bed.force_balance, task.force_balance);
    } else if (bed.overlap > task.overlap) {
      out.outcome = Outcome::did_not_converge;
      out.reason = fmt::format("the overlap stayed at {:.2g} (limit {:.2g}) though contacts were stiffened {} times",
                               bed.overlap, task.overlap, bed.stiffenings);
    }
    const auto count = [](std::int64_t n) { return static_cast<double>(n); };
    out.measures = {{"N", count(static_cast<std::int64_t>(packing.count())), "1"},
                    {"steps", count(bed.steps), "1"},
                    {"step_halvings", count(bed.halvings), "1"},
                    {"stiffenings", count(bed.stiffenings), "1"},
                    {"list_rebuilds", count(bed.list_rebuilds), "1"},
                    {"residual_overlap", bed.overlap, "1"},
                    {"force_balance", bed.force_balance, "1"},
                    {"effective_modulus", bed.modulus * units.pressure, "Pa"}};
    if (in_time(task)) {
      out.measures.push_back({"kinetic_energy", bed.kinetic_energy, "1"});
      out.measures.push_back({"step", bed.step * units.time, "s"});
    }
    if (task.adhesion > 0)
      out.measures.push_back({"tabor", tabor_, "1"});
    out.effects = effects(task);
    return out;
  }

  static bool in_time(const SettleTask<D>& task) { return task.effects != ContactEffects{}; }

  [[nodiscard]] Effects effects(const SettleTask<D>& task) const {
    Effects e;
    e.simulated = {"gravity", "Hertz contacts (softened to the tolerated overlap)"};
    const std::string quasi_static = "no friction and no adhesion: energy is minimised, which has no time";
    if (in_time(task)) {
      e.simulated.emplace_back("inertia");
      e.simulated.emplace_back("damping by restitution (Tsuji)");
    } else {
      e.left_out.push_back({"inertia", quasi_static});
      e.left_out.push_back({"damping", quasi_static});
    }
    if (task.effects.friction) {
      e.simulated.emplace_back("friction (Mindlin, Coulomb), with rotation and memory of contacts");
    } else {
      e.left_out.push_back({"friction", "mu = 0"});
      e.left_out.push_back({"rotation", "without friction nothing turns a sphere"});
    }
    if (task.effects.adhesion == AdhesionLaw::none) {
      e.left_out.push_back({"adhesion", "W = 0"});
    } else {
      const bool forced = method_.material.adhesion_model != AdhesionModel::tabor;
      const std::string why = forced ? std::string("as asked for") : fmt::format("Tabor's parameter {:.3g}", tabor_);
      e.simulated.push_back(
          fmt::format("adhesion ({}: {})", task.effects.adhesion == AdhesionLaw::jkr ? "JKR" : "DMT", why));
    }
    e.left_out.push_back({"rolling resistance", "the method has no parameter for it"});
    return e;
  }

  const Request& request_;
  const Method& method_;
  LengthUnit unit_ = LengthUnit::um;
  Vec<D> size_ = Vec<D>::Zero();
  std::array<bool, D> periodic_{};
  Cloud<D> cloud_;
  double tabor_ = 0;
};

} // namespace

Generated generate_dem_gravity(const Request& request) {
  return with_dimension(request.job.scene.dimension, [&](auto d) { return DemGravityRun<d>(request).run(); });
}

} // namespace tamp
