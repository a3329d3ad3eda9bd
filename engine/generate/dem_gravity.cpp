// From a job to a settling task in units of the bed, and from the settled bed to a packing.
#include "engine/generate/dem_gravity.h"

#include "engine/dem/settle.h"
#include "engine/generate/harden.h"
#include "engine/generate/settling_scene.h"

#include <fmt/format.h>

#include <cmath>

namespace tamp {

namespace {

template <int D>
class DemGravityRun {
public:
  explicit DemGravityRun(const Request& request) : method_(request.job.method), scene_(request), request_(request) {}

  Generated run() {
    if (!scene_.obstacle.empty()) {
      Generated out;
      out.outcome = Outcome::not_applicable;
      out.reason = scene_.obstacle;
      return out;
    }
    const SettleTask<D> task = scene_.task(request_);
    return result(task, settle(task));
  }

private:
  Generated result(const SettleTask<D>& task, const Settled<D>& bed) {
    Generated out;
    out.packing = scene_.packing(bed.centres);
    const double wider = method_.hard ? harden(out.packing) : 1;
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
    out.measures = {{"N", count(static_cast<std::int64_t>(out.packing.count())), "1"},
                    {"steps", count(bed.steps), "1"},
                    {"step_halvings", count(bed.halvings), "1"},
                    {"stiffenings", count(bed.stiffenings), "1"},
                    {"list_rebuilds", count(bed.list_rebuilds), "1"},
                    {"residual_overlap", method_.hard ? 0 : bed.overlap, "1"},
                    {"hard_cost_phi_relative", 1 - std::pow(wider, -D), "1"},
                    {"force_balance", bed.force_balance, "1"},
                    {"effective_modulus", bed.modulus * scene_.units.pressure, "Pa"}};
    if (!task.minimise) {
      out.measures.push_back({"kinetic_energy", bed.kinetic_energy, "1"});
      out.measures.push_back({"step", bed.step * scene_.units.time, "s"});
    }
    if (task.adhesion > 0)
      out.measures.push_back({"tabor", scene_.tabor, "1"});
    return out;
  }

  const Method& method_;
  SettlingScene<D> scene_;
  const Request& request_;
};

} // namespace

Generated generate_dem_gravity(const Request& request) {
  return with_dimension(request.job.scene.dimension, [&](auto d) { return DemGravityRun<d>(request).run(); });
}

} // namespace tamp
