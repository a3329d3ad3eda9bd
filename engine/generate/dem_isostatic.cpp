// From a job to a compression task, and from what came of it to a packing.
#include "engine/generate/dem_isostatic.h"

#include "engine/dem/compress.h"
#include "engine/generate/radius_sampler.h"
#include "engine/generate/random_close_packing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tamp {

namespace {

/// A box may be no narrower than this many largest diameters: its spheres must not meet their own images.
constexpr double kNarrowest = 1.2;

/// Spare of the widened box, relative, so that rounding makes no overlap.
constexpr double kRounding = 1e-14;

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
    task_.checkpoint = request_.checkpoint;
    if (request_.progress)
      task_.progress = [this] { request_.progress(task_.radii.size()); };
    Compressed<D> end = compress(task_);
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
    task_.size *= std::pow(solid() / (method_.start_phi * task_.size.prod()), 1.0 / D);
    RandomStream places(request_.key, static_cast<std::uint64_t>(Stream::positions));
    task_.positions.resize(task_.radii.size() * D);
    for (std::size_t i = 0; i < task_.positions.size(); ++i)
      task_.positions[i] = places.uniform() * task_.size[static_cast<int>(i % D)];
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
    const double soft_phi = end.phi;
    if (method_.hard && end.overlap > 0) {
      const double wider = (1 + kRounding) / end.nearest;
      end.size *= wider;
      for (double& x : end.positions)
        x *= wider;
      end.phi /= std::pow(wider, D);
      end.overlap = 0;
    }
    packing.dimension = D;
    packing.unit = unit_;
    for (int a = 0; a < D; ++a) {
      packing.size[static_cast<std::size_t>(a)] = end.size[a];
      packing.boundary[static_cast<std::size_t>(a)] = Boundary::periodic;
    }
    packing.positions = std::move(end.positions);
    packing.radii = task_.radii;
    if (end.end == CompressEnd::jammed) {
      out.reason = fmt::format(
          "jammed below the packing fraction {:g}: at a pressure of {:.2g}, with overlaps up to {:.2g}, it is {:.4g}",
          method_.target_phi, end.pressure, end.overlap, end.phi);
    } else if (end.end == CompressEnd::gave_up) {
      out.reason =
          fmt::format("after {} evaluations the overlap is {:.2g} (limit {:g}), net forces {:.2g} of contacts'",
                      end.evaluations, end.overlap, method_.overlap_tolerance, end.force_balance);
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
    const std::string minimised = "without friction and adhesion the enthalpy is minimised, which has no time";
    out.effects.simulated = {"elastic repulsion (harmonic)", "isotropic compression of a periodic box"};
    out.effects.left_out = {{"gravity", "isostatic: the load is a pressure"},
                            {"walls", "isostatic: every axis is periodic"},
                            {"inertia", minimised},
                            {"damping", minimised},
                            {"friction", "the method has none (NANF)"},
                            {"rotation", "without friction nothing turns a sphere"},
                            {"adhesion", "the method has none (NANF)"}};
    return out;
  }

  const Request& request_;
  const DemIsostatic& method_;
  LengthUnit unit_ = LengthUnit::um;
  CompressTask<D> task_;
};

} // namespace

Generated generate_dem_isostatic(const Request& request) {
  return with_dimension(request.job.scene.dimension,
                        [&](auto d) { return DemIsostaticRun<decltype(d)::value>(request).run(); });
}

} // namespace tamp
