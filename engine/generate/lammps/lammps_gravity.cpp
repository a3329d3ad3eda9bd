// From a job to stages of LAMMPS, and from its last state to a packing.
#include "engine/generate/lammps/lammps_gravity.h"

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/dem/time_step.h"
#include "engine/generate/harden.h"
#include "engine/generate/lammps/lammps_program.h"
#include "engine/generate/lammps/lammps_script.h"
#include "engine/generate/lammps/work_folder.h"
#include "engine/generate/settling_scene.h"
#include "engine/model/lammps_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tamp {

namespace {

namespace fs = std::filesystem;

/// Room above the highest sphere of the cloud: an edge of LAMMPS's box must hold all centres.
constexpr double kHeadroom = 1.2;
/// Contacts become stiffer by at most this factor at once, so that the bed is not thrown up by what they held; the last
/// stage aims at this share of the tolerated overlap.
constexpr double kStiffening = 4;
constexpr double kStiffenAim = 0.9;
constexpr int kMostStages = 12;
constexpr int kMostHalvings = 3;
/// Overlap that is expected of the first, soft stage, in tolerated ones.
constexpr double kFirstOverlap = 10;
/// No bed takes longer than this many times a free fall from the top.
constexpr double kLongest = 300;

struct Look {
  std::int64_t step = 0;
  double kinetic = 0;
  double height = 0;
  double contacts = 0;
  double balance = 0;
  std::string phase;
};

std::vector<Look> read_looks(const fs::path& file) {
  std::vector<Look> looks;
  std::istringstream lines(fs::exists(file) ? read_file(file) : std::string());
  for (Look look; lines >> look.step >> look.kinetic >> look.height >> look.contacts >> look.balance >> look.phase;)
    looks.push_back(look);
  return looks;
}

template <int D>
class LammpsGravityRun {
public:
  explicit LammpsGravityRun(const Request& request)
      : method_(request.job.method), scene_(request), folder_(request.folder), deadline_(request.wall_s) {
    if (scene_.obstacle.empty())
      task_ = scene_.task(request, true);
  }

  Generated run() {
    Generated out;
    try {
      if (!scene_.obstacle.empty())
        throw NotApplicable(scene_.obstacle);
      program_ = find_lammps(folder_.path());
      program_.require(lammps_styles(task_));
    } catch (const NotApplicable& e) {
      out.outcome = Outcome::not_applicable;
      out.reason = e.what();
      folder_.remove();
      return out;
    }
    settle();
    return result();
  }

private:
  void settle() {
    write_start();
    LammpsStage stage;
    stage.modulus = task_.modulus;
    stage.last = false;
    stage.overlap = kFirstOverlap * task_.overlap;
    stage.step = longest_step(stage.overlap);
    stage.height_drift = method_.lammps_gravity.height_drift;
    stage.contact_drift = method_.lammps_gravity.contact_drift;
    for (stages_ = 1;; ++stages_) {
      stage.last = stage.last || stages_ == kMostStages;
      run_stage(stage);
      modulus_ = stage.modulus;
      packing_ = scene_.packing(read_centres());
      overlap_ = deepest_overlap(packing_);
      const bool deep = overlap_ > task_.overlap && stage.modulus < task_.largest_modulus;
      if (!rested_ || stages_ == kMostStages || (stage.last && !deep))
        return;
      late_ = deadline_.over();
      if (late_)
        return;
      stage.first = false;
      stage.last = !deep;
      stage.overlap = overlap_;
      if (deep) { // under the same force δ ∝ E*^{−2/3}
        ++stiffenings_;
        stage.modulus =
            std::min(task_.largest_modulus,
                     stage.modulus * std::min(kStiffening, std::pow(overlap_ / (kStiffenAim * task_.overlap), 1.5)));
      }
    }
  }

  void write_start() {
    Packing start;
    start.dimension = D;
    start.unit = LengthUnit::m; // of no account: LAMMPS gets numbers
    start.radii = task_.radii;
    double top = 0;
    for (std::size_t i = 0; i < task_.centres.size(); ++i) {
      const Vec<D>& c = task_.centres[i];
      start.positions.insert(start.positions.end(), c.data(), c.data() + D);
      top = std::max(top, c[vertical<D>] + task_.radii[i]);
    }
    top_ = top;
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      start.size[n] = a == vertical<D> ? kHeadroom * top : task_.box.size[a];
      start.boundary[n] = task_.box.periodic[n] ? Boundary::periodic : Boundary::wall;
    }
    write_lammps_data(folder_.path() / LammpsFiles::start, start);
  }

  [[nodiscard]] double fall_time() const { return std::sqrt(2 * top_ / task_.gravity); }

  /// In the fall; afterwards inertia goes by the step.
  [[nodiscard]] double longest_step(double overlap) const {
    const double median = lammps_median(task_.radii);
    std::vector<double> masses = task_.masses;
    for (std::size_t i = 0; i < masses.size(); ++i)
      masses[i] *= std::max(1.0, std::pow(median / task_.radii[i], 2));
    return stable_step(task_.radii, masses, task_.modulus, task_.gravity * fall_time(), overlap);
  }

  /// Runs a stage with the longest step that LAMMPS gets through with.
  void run_stage(LammpsStage stage) {
    const double longest = stage.step;
    stage.step *= std::pow(0.5, halvings_);
    stage.most_looks = static_cast<std::int64_t>(std::ceil(kLongest * fall_time() * std::sqrt(task_.gravity)));
    stage.seconds = deadline_.left();
    const std::string script = fmt::format("in.{}", stages_);
    write_atomically(folder_.path() / script, gravity_script(task_, stage));
    fs::remove(folder_.path() / LammpsFiles::looks);
    try {
      cpu_s_ += run_lammps(program_, folder_.path(), script);
    } catch (const Error&) {
      // Spheres that fly out of the box, or whose forces are no numbers any more, speak of too long a step.
      if (halvings_ == kMostHalvings)
        throw;
      ++halvings_;
      stage.step = longest;
      return run_stage(stage);
    }
    step_ = stage.step;
    const std::string end = read_file(folder_.path() / LammpsFiles::end);
    rested_ = end.starts_with("rest");
    late_ = end.starts_with("time");
    looks_ = read_looks(folder_.path() / LammpsFiles::looks);
  }

  std::vector<Vec<D>> read_centres() const {
    Surroundings known;
    known.dimension = D;
    const ReadPacking read = read_lammps_dump(folder_.path() / LammpsFiles::state, known);
    if (read.packing.count() != task_.radii.size())
      throw Error(fmt::format("LAMMPS returned {} of {} spheres", read.packing.count(), task_.radii.size()));
    std::vector<Vec<D>> centres;
    for (std::size_t i = 0; i < read.packing.count(); ++i)
      centres.push_back(read.packing.centre<D>(i));
    return centres;
  }

  Generated result() {
    Generated out;
    out.packing = std::move(packing_);
    const double wider = method_.hard ? harden(out.packing) : 1;
    const Look last = looks_.empty() ? Look{} : looks_.back();
    if (late_) {
      out.outcome = Outcome::time_limited;
      out.reason = fmt::format("{}: net forces {:.2g} (limit {:.2g}), overlap {:.2g} (limit {:.2g})",
                               deadline_.reason(), last.balance, task_.force_balance, overlap_, task_.overlap);
    } else if (!rested_) {
      out.outcome = Outcome::did_not_converge;
      out.reason = fmt::format("the bed did not come to rest: net forces {:.2g} (limit {:.2g}), kinetic energy {:.2g} "
                               "(limit {:.2g}), {}",
                               last.balance, task_.force_balance, last.kinetic, task_.kinetic_energy, ended_by());
    } else if (overlap_ > task_.overlap) {
      out.outcome = Outcome::did_not_converge;
      out.reason = fmt::format("the overlap stayed at {:.2g} (limit {:.2g}) in {} stages of stiffer contacts", overlap_,
                               task_.overlap, stages_);
    }
    out.measures = {{"N", static_cast<double>(out.packing.count()), "1"},
                    {"steps", static_cast<double>(last.step), "1"},
                    {"step_halvings", static_cast<double>(halvings_), "1"},
                    {"stiffenings", static_cast<double>(stiffenings_), "1"},
                    {"residual_overlap", method_.hard ? 0 : overlap_, "1"},
                    {"hard_cost_phi_relative", 1 - std::pow(wider, -D), "1"},
                    {"effective_modulus", modulus_ * scene_.units.pressure, "Pa"},
                    {"kinetic_energy", last.kinetic, "1"},
                    {"force_balance", last.balance, "1"},
                    {"step", step_ * scene_.units.time, "s"}};
    if (task_.adhesion > 0)
      out.measures.push_back({"tabor", scene_.tabor, "1"});
    if (rested_)
      out.effects.simulated.push_back(
          fmt::format("rest by forces, kinetic energy, height and contacts ({})", ended_by()));
    out.programs["LAMMPS"] = fmt::format("{} ({}): {}", program_.version, fmt::join(program_.command, " "),
                                         fmt::join(lammps_styles(task_), ", "));
    out.programs_cpu_s = cpu_s_;
    folder_.tidy();
    return out;
  }

  /// Which of the limits was met last, or is not met.
  [[nodiscard]] std::string ended_by() const {
    std::string late = "all limits were met at once";
    for (std::size_t i = 1; i < looks_.size(); ++i) {
      if (looks_[i].phase != "bed")
        continue;
      std::vector<std::string> missed;
      if (!(looks_[i].balance < task_.force_balance))
        missed.emplace_back("forces");
      if (!(looks_[i].kinetic < task_.kinetic_energy))
        missed.emplace_back("kinetic energy");
      if (!(std::abs(looks_[i].height - looks_[i - 1].height) < method_.lammps_gravity.height_drift))
        missed.emplace_back("height");
      if (!(std::abs(looks_[i].contacts - looks_[i - 1].contacts) < method_.lammps_gravity.contact_drift))
        missed.emplace_back("contacts");
      if (!missed.empty())
        late = fmt::format("last to meet its limit: {}", fmt::join(missed, ", "));
    }
    return late;
  }

  const Method& method_;
  SettlingScene<D> scene_;
  WorkFolder folder_;
  Deadline deadline_;
  SettleTask<D> task_;
  LammpsProgram program_;
  Packing packing_;
  std::vector<Look> looks_; // of the last stage
  bool rested_ = false;
  bool late_ = false; // the job has no more time
  double overlap_ = 0;
  double modulus_ = 0;
  double step_ = 0;
  double top_ = 0;
  double cpu_s_ = 0;
  int stages_ = 0;
  int stiffenings_ = 0;
  int halvings_ = 0;
};

} // namespace

Generated generate_lammps_gravity(const Request& request) {
  return with_dimension(request.job.scene.dimension,
                        [&](auto d) { return LammpsGravityRun<decltype(d)::value>(request).run(); });
}

} // namespace tamp
