// From a job to stages of less and less pressure, and from LAMMPS's last box to a packing.
#include "engine/generate/lammps/lammps_isostatic.h"

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/dem/time_step.h"
#include "engine/generate/harden.h"
#include "engine/generate/lammps/isostatic_script.h"
#include "engine/generate/lammps/lammps_program.h"
#include "engine/generate/lammps/lammps_script.h"
#include "engine/generate/lammps/work_folder.h"
#include "engine/generate/loose_cloud.h"
#include "engine/generate/radius_sampler.h"
#include "engine/model/lammps_text.h"
#include "engine/model/random_close_packing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tamp {

namespace {

/// A box may be no narrower than this many largest diameters: its spheres must not meet their own images.
constexpr double kNarrowest = 1.2;
/// The pressure of the first stage in units of E*; overlaps are of the order of (p/E*)^{2/3}.
constexpr double kFirstPressure = 1e-3;
/// Pressure falls by this factor at most from one stage to the next, which aims at this share of the tolerated overlap.
constexpr double kLess = 10;
constexpr double kAim = 0.8;
constexpr int kMostStages = 12;
constexpr int kMostHalvings = 3;
constexpr std::int64_t kMostLooks = 3000;
/// Deepest overlap in units of (p/E*)^{2/3}, by which the step is chosen: contacts of force chains between unequal
/// spheres go far beyond the mean.
constexpr double kDeep = 10;
constexpr double kContactDrift = 1e-2;

template <int D>
double volume(double radius) {
  return (D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3) * std::pow(radius, D);
}

template <int D>
class LammpsIsostaticRun {
public:
  explicit LammpsIsostaticRun(const Request& request)
      : request_(request), method_(request.job.method), folder_(request.folder), deadline_(request.wall_s) {}

  Generated run() {
    Generated out;
    try {
      set_out();
      program_ = find_lammps(folder_.path());
      program_.require(isostatic_styles(D));
    } catch (const NotApplicable& e) {
      out.outcome = Outcome::not_applicable;
      out.reason = e.what();
      folder_.remove();
      return out;
    }
    compress();
    return result();
  }

private:
  /// Spheres and the box to start from; throws NotApplicable.
  void set_out() {
    if (request_.parent != nullptr) {
      const Packing& parent = *request_.parent;
      if (parent.dimension != D)
        throw NotApplicable("the packing to start from has another dimension than the scene");
      start_ = parent;
      for (std::size_t i = 0; i < parent.count(); ++i) // an open bed may be higher than its box
        start_.size[D - 1] = std::max(start_.size[D - 1], parent.centre<D>(i)[D - 1] + parent.radii[i]);
    } else {
      throw_in();
    }
    if (start_.radii.empty())
      throw NotApplicable("there are no spheres to compress");
    start_.boundary.fill(Boundary::periodic);
    const double widest = 2 * *std::max_element(start_.radii.begin(), start_.radii.end());
    double narrowest = *std::min_element(start_.size.begin(), start_.size.begin() + D);
    narrowest *= std::pow(fraction(start_), 1.0 / D); // of a box without voids
    if (!(kNarrowest * widest < narrowest))
      throw NotApplicable(fmt::format("the largest sphere, {:g} wide, would meet its own image in a periodic box down "
                                      "to {:g} wide",
                                      widest, narrowest));
    unit_ = std::accumulate(start_.radii.begin(), start_.radii.end(), 0.0) / static_cast<double>(start_.radii.size());
    task_.modulus = 1;
    task_.restitution = method_.material.restitution;
    for (const double r : start_.radii) {
      task_.radii.push_back(r / unit_);
      task_.masses.push_back(volume<3>(r / unit_));
    }
  }

  void throw_in() {
    const Scene& scene = request_.job.scene;
    Vec<D> size;
    for (int a = 0; a < D; ++a)
      size[a] = scene.size[static_cast<std::size_t>(a)];
    const SizeLaw law(scene.psd, D);
    const double full = random_close_packing(law, D) * size.prod() / (volume<D>(1) * law.moment(D));
    const double count = scene.count > 0 ? static_cast<double>(scene.count) : std::max(1.0, std::round(full));
    const std::vector<double> radii = draw_radii(law, scene.sampler, static_cast<std::size_t>(count),
                                                 RandomStream(request_.key, static_cast<std::uint64_t>(Stream::radii)));
    if (radii.empty())
      return;
    PeriodicCloud<D> start =
        loose_periodic_cloud<D>(size / std::pow(size.prod(), 1.0 / D), radii, method_.dem_gravity.cloud_phi,
                                RandomStream(request_.key, static_cast<std::uint64_t>(Stream::positions)));
    start_.dimension = D;
    start_.unit = scene.unit;
    start_.radii = std::move(start.cloud.radii);
    for (const Vec<D>& c : start.cloud.centres)
      start_.positions.insert(start_.positions.end(), c.data(), c.data() + D);
    for (int a = 0; a < D; ++a)
      start_.size[static_cast<std::size_t>(a)] = start.size[a];
  }

  static double fraction(const Packing& packing) {
    double solid = 0;
    for (const double r : packing.radii)
      solid += volume<D>(r);
    for (std::size_t a = 0; a < D; ++a)
      solid /= packing.size[a];
    return solid;
  }

  void compress() {
    Packing scaled = start_;
    scaled.radii = task_.radii;
    for (double& x : scaled.positions)
      x /= unit_;
    for (double& edge : scaled.size)
      edge /= unit_;
    write_lammps_data(folder_.path() / LammpsFiles::start, scaled);
    IsostaticStage stage;
    stage.pressure = kFirstPressure;
    stage.stop_strain = method_.dem_isostatic.stop_strain;
    stage.contact_drift = kContactDrift;
    stage.most_looks = kMostLooks;
    double deep = kDeep * std::pow(stage.pressure, 2.0 / 3);
    for (stages_ = 1;; ++stages_) {
      run_stage(stage, deep);
      pressure_ = stage.pressure;
      read_end();
      const double tolerated = method_.dem_isostatic.overlap_tolerance;
      if (overlap_ <= tolerated || !rested_ || stages_ == kMostStages)
        return;
      late_ = deadline_.over();
      if (late_)
        return;
      stage.first = false; // δ ∝ p^{2/3}
      deep = overlap_;
      stage.pressure /= std::min(kLess, std::pow(overlap_ / (kAim * tolerated), 1.5));
    }
  }

  void run_stage(IsostaticStage stage, double deep) {
    stage.step = stable_step(task_.radii, task_.masses, task_.modulus, 0, deep) * std::pow(0.5, halvings_);
    stage.seconds = deadline_.left();
    const std::string script = fmt::format("in.{}", stages_);
    write_atomically(folder_.path() / script, isostatic_script(task_, stage));
    std::filesystem::remove(folder_.path() / LammpsFiles::looks);
    try {
      cpu_s_ += run_lammps(program_, folder_.path(), script);
    } catch (const Error&) {
      if (halvings_ == kMostHalvings)
        throw;
      ++halvings_;
      return run_stage(stage, deep);
    }
    const std::string end = read_file(folder_.path() / LammpsFiles::end);
    rested_ = end.starts_with("rest");
    late_ = end.starts_with("time");
  }

  void read_end() {
    Surroundings known;
    known.dimension = D;
    end_ = read_lammps_dump(folder_.path() / LammpsFiles::state, known).packing;
    if (end_.count() != start_.count())
      throw Error(fmt::format("LAMMPS returned {} of {} spheres", end_.count(), start_.count()));
    end_.unit = start_.unit;
    end_.radii = start_.radii;
    for (double& edge : end_.size)
      edge *= unit_;
    for (std::size_t k = 0; k < end_.positions.size(); ++k) {
      const double edge = end_.size[k % D];
      double& x = end_.positions[k];
      x *= unit_;
      x -= std::floor(x / edge) * edge;
    }
    overlap_ = deepest_overlap(end_);
  }

  Generated result() {
    Generated out;
    out.packing = std::move(end_);
    const double soft_phi = fraction(out.packing);
    if (method_.hard)
      harden(out.packing);
    if (late_) {
      out.outcome = Outcome::time_limited;
      out.reason = fmt::format("{}: at a pressure of {:.2g}, overlap {:.2g} (limit {:g})", deadline_.reason(),
                               pressure_, overlap_, method_.dem_isostatic.overlap_tolerance);
    } else if (!rested_) {
      out.outcome = Outcome::did_not_converge;
      out.reason =
          fmt::format("the box did not come to rest in {} looks at a pressure of {:.2g}", kMostLooks, pressure_);
    } else if (overlap_ > method_.dem_isostatic.overlap_tolerance) {
      out.outcome = Outcome::did_not_converge;
      out.reason = fmt::format("the overlap stayed at {:.2g} (limit {:g}) at a pressure of {:.2g}", overlap_,
                               method_.dem_isostatic.overlap_tolerance, pressure_);
    }
    out.measures = {{"N", static_cast<double>(out.packing.count()), "1"},
                    {"phi_box", fraction(out.packing), "1"},
                    {"residual_overlap", method_.hard ? 0 : overlap_, "1"},
                    {"hard_cost_phi", soft_phi - fraction(out.packing), "1"},
                    {"pressure", pressure_, "1"},
                    {"stages", static_cast<double>(stages_), "1"},
                    {"step_halvings", static_cast<double>(halvings_), "1"}};
    out.programs["LAMMPS"] = fmt::format("{} ({}): {}", program_.version, fmt::join(program_.command, " "),
                                         fmt::join(isostatic_styles(D), ", "));
    out.programs_cpu_s = cpu_s_;
    folder_.tidy();
    return out;
  }

  const Request& request_;
  const Method& method_;
  WorkFolder folder_;
  Deadline deadline_;
  LammpsProgram program_;
  Packing start_;
  Packing end_;
  SettleTask<D> task_; // what contacts are made of, in units of the mean radius, density and E*
  double unit_ = 1;    // the mean radius
  double pressure_ = 0;
  double overlap_ = 0;
  double cpu_s_ = 0;
  bool rested_ = false;
  bool late_ = false; // the job has no more time
  int stages_ = 0;
  int halvings_ = 0;
};

} // namespace

Generated generate_lammps_isostatic(const Request& request) {
  return with_dimension(request.job.scene.dimension,
                        [&](auto d) { return LammpsIsostaticRun<decltype(d)::value>(request).run(); });
}

} // namespace tamp
