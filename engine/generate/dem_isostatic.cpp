// From a job to a compression task, and from what came of it to a packing.
#include "engine/generate/dem_isostatic.h"

#include "engine/contact/hertz.h"
#include "engine/dem/compress.h"
#include "engine/generate/harden.h"
#include "engine/generate/loose_cloud.h"
#include "engine/generate/material_effects.h"
#include "engine/generate/radius_sampler.h"
#include "engine/model/random_close_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tamp {

namespace {

/// A box may be no narrower than this many largest diameters: its spheres must not meet their own images.
constexpr double kNarrowest = 1.2;

/// Contacts that rub or adhere start so soft that the load, or adhesion alone, makes overlaps of this order. Measured
/// on 2000 equal spheres with mu 0.577: 0.002, 0.02 and 0.1 end at the same density within its scatter of 0.003.
constexpr double kSoftStart = 0.02;

template <int D>
double volume(double radius) {
  return (D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3) * std::pow(radius, D);
}

template <int D>
class DemIsostaticRun {
public:
  explicit DemIsostaticRun(const Request& request) : request_(request), method_(request.job.method.dem_isostatic) {}

  Generated run() {
    if (request_.parent != nullptr)
      start_from_packing(*request_.parent);
    else
      start_from_scene(request_.job.scene);
    if (std::string reason = obstacle(); !reason.empty()) {
      Generated out;
      out.outcome = Outcome::not_applicable;
      out.reason = std::move(reason);
      return out;
    }
    task_.target_phi = method_.target_phi;
    task_.overlap = method_.overlap_tolerance;
    task_.pressure = method_.pressure;
    task_.rate = method_.rate;
    task_.stop_strain = method_.stop_strain;
    task_.force_balance = method_.force_tolerance;
    task_.checkpoint = request_.checkpoint;
    if (request_.progress)
      task_.progress = [this] { request_.progress(task_.radii.size()); };
    set_contacts();
    Compressed<D> end = compress(task_);
    for (double& x : end.positions)
      x *= length_;
    end.size *= length_;
    return result(std::move(end));
  }

private:
  void start_from_packing(const Packing& parent) {
    unit_ = parent.unit;
    task_.radii = parent.radii;
    task_.positions = parent.positions;
    for (int a = 0; a < D; ++a)
      task_.size[a] = parent.size[static_cast<std::size_t>(a)];
  }

  void start_from_scene(const Scene& scene) {
    unit_ = scene.unit;
    for (int a = 0; a < D; ++a)
      task_.size[a] = scene.size[static_cast<std::size_t>(a)];
    const SizeLaw law(scene.psd, D);
    const double end_phi = stated(method_.target_phi) ? method_.target_phi : random_close_packing(law, D);
    const double full = end_phi * task_.size.prod() / (volume<D>(1) * law.moment(D));
    const double count = scene.count > 0 ? static_cast<double>(scene.count) : std::max(1.0, std::round(full));
    task_.radii = draw_radii(law, scene.sampler, static_cast<std::size_t>(count),
                             RandomStream(request_.key, static_cast<std::uint64_t>(Stream::radii)));
    RandomStream places(request_.key, static_cast<std::uint64_t>(Stream::positions));
    if (in_time() && !task_.radii.empty()) {
      PeriodicCloud<D> start =
          loose_periodic_cloud<D>(task_.size, task_.radii, request_.job.method.dem_gravity.cloud_phi, places);
      task_.size = start.size;
      task_.radii = std::move(start.cloud.radii);
      for (const Vec<D>& c : start.cloud.centres)
        task_.positions.insert(task_.positions.end(), c.data(), c.data() + D);
      return;
    }
    task_.size *= std::pow(solid() / (method_.start_phi * task_.size.prod()), 1.0 / D);
    task_.positions.resize(task_.radii.size() * D);
    for (std::size_t i = 0; i < task_.positions.size(); ++i)
      task_.positions[i] = places.uniform() * task_.size[static_cast<int>(i % D)];
  }

  /// Whether motion is followed, not enthalpy minimised.
  [[nodiscard]] bool in_time() const { return moves_in_time(request_.job.method.material); }

  /// Where motion is followed, takes the mean radius and the load as units and sets what the contacts need.
  void set_contacts() {
    if (!in_time())
      return;
    const Material& material = request_.job.method.material;
    length_ = std::accumulate(task_.radii.begin(), task_.radii.end(), 0.0) / static_cast<double>(task_.radii.size());
    for (double& x : task_.positions)
      x /= length_;
    for (double& r : task_.radii)
      r /= length_;
    task_.size /= length_;
    const double metre = length_ * metres(unit_);
    tabor_ = tabor_of(material, metre);
    task_.effects = effects_of(material, tabor_);
    task_.in_time = true;
    task_.poisson = material.poisson;
    task_.friction = material.friction;
    task_.adhesion = material.adhesion / (method_.load * metre);
    task_.load = 1;
    task_.largest_modulus = hard_modulus(material) / method_.load;
    // Of the mean radius under the load on its cross-section, of the smallest under half its own pull-off force 2πWR.
    const double smallest = *std::min_element(task_.radii.begin(), task_.radii.end());
    task_.modulus =
        std::min(task_.largest_modulus, std::max(hertz_modulus(std::numbers::pi, 0.5, kSoftStart),
                                                 hertz_modulus(std::numbers::pi / 2 * task_.adhesion * smallest,
                                                               0.5 * smallest, kSoftStart * smallest)));
  }

  [[nodiscard]] double solid() const {
    double sum = 0;
    for (const double r : task_.radii)
      sum += volume<D>(r);
    return sum;
  }

  /// Why the spheres cannot be compressed; empty if they can.
  [[nodiscard]] std::string obstacle() const {
    if (request_.parent != nullptr && request_.parent->dimension != D)
      return "the packing to start from has another dimension than the scene";
    if (task_.radii.empty())
      return "there are no spheres to compress";
    const double widest = 2 * *std::max_element(task_.radii.begin(), task_.radii.end());
    const double full = std::pow(solid() / task_.size.prod(), 1.0 / D); // edges of a box without voids, relative
    if (const double narrowest = full * task_.size.minCoeff(); !(kNarrowest * widest < narrowest))
      return fmt::format("the largest sphere, {:g} wide, would meet its own image in a periodic box down to {:g} wide",
                         widest, narrowest);
    return {};
  }

  Generated result(Compressed<D> end) {
    Generated out;
    Packing& packing = out.packing;
    packing.dimension = D;
    packing.unit = unit_;
    for (int a = 0; a < D; ++a) {
      packing.size[static_cast<std::size_t>(a)] = end.size[a];
      packing.boundary[static_cast<std::size_t>(a)] = Boundary::periodic;
    }
    packing.positions = std::move(end.positions);
    packing.radii = task_.radii;
    for (double& r : packing.radii)
      r *= length_;
    const double soft_phi = end.phi;
    if (request_.job.method.hard) {
      end.phi /= std::pow(harden(packing), D);
      end.overlap = 0;
    }
    if (end.end == CompressEnd::jammed) {
      out.reason = fmt::format("jammed below the packing fraction {:g}: at a pressure of {:.2g}{}, with overlaps up to "
                               "{:.2g}, it is {:.4g}",
                               method_.target_phi, end.pressure, in_time() ? " of the load" : "", end.overlap, end.phi);
    } else if (end.end == CompressEnd::gave_up) {
      out.reason =
          fmt::format("after {} evaluations the overlap is {:.2g} (limit {:g}), net forces {:.2g} of contacts'{}",
                      end.evaluations, end.overlap, method_.overlap_tolerance, end.force_balance,
                      in_time() && end.modulus >= task_.largest_modulus
                          ? "; contacts are as stiff as the material: the load or adhesion makes this overlap"
                          : "");
    }
    if (!out.reason.empty())
      out.outcome = Outcome::did_not_converge;
    out.measures = {{"N", static_cast<double>(packing.count()), "1"},
                    {"phi_box", end.phi, "1"},
                    {"residual_overlap", end.overlap, "1"},
                    {"hard_cost_phi", soft_phi - end.phi, "1"},
                    {"pressure", end.pressure, "1"},
                    {"force_balance", end.force_balance, "1"},
                    {"evaluations", static_cast<double>(end.evaluations), "1"},
                    {"list_rebuilds", static_cast<double>(end.list_rebuilds), "1"},
                    {"list_repairs", static_cast<double>(end.list_repairs), "1"}};
    if (in_time()) {
      out.measures.push_back({"effective_modulus", end.modulus * method_.load, "Pa"});
      out.measures.push_back({"stiffenings", static_cast<double>(end.stiffenings), "1"});
      out.measures.push_back({"step_halvings", static_cast<double>(end.halvings), "1"});
      out.measures.push_back({"adhesion_over_load", task_.adhesion, "1"}); // W/(p r), r the mean radius
      if (task_.adhesion > 0)
        out.measures.push_back({"tabor", tabor_, "1"});
    }
    return out;
  }

  const Request& request_;
  const DemIsostatic& method_;
  double length_ = 1; // what the task's lengths are in, in the scene's unit
  double tabor_ = 0;
  LengthUnit unit_ = LengthUnit::um;
  CompressTask<D> task_;
};

} // namespace

Generated generate_dem_isostatic(const Request& request) {
  return with_dimension(request.job.scene.dimension,
                        [&](auto d) { return DemIsostaticRun<decltype(d)::value>(request).run(); });
}

} // namespace tamp
