// FIRE over the places of the spheres and the logarithm of the box edge together, at pressures that fall in stages.
//
// Minimised is the enthalpy H = E + p V, with positions x = L u and ε = ln L as variables: −∂H/∂u L⁻¹ = F and
// −∂H/∂ε = Σ f d − D p V. Masses are what makes all frequencies of the order of one: of a sphere the stiffness of its
// contacts, of the box Σ k d². Compression at a high pressure jams the spheres with a rigid backbone; lowering it then
// takes the overlaps down to the tolerance while they stay jammed (as opposed to a quench that stops as soon as
// nothing overlaps). A stage ends when forces balance, or when the box has all but come to rest: small spheres in the
// pores between large ones creep for as long as one cares to look, and the box feels next to nothing of it.
//
// A prescribed packing fraction is come to from above: a quench in a box of that size would take overlaps away at a
// rate that falls with them. Once the pressure is so low that widening the box to the prescribed size parts most
// contacts, it is widened, ε is fixed and E alone minimised, which only has to part the deep ones.
#include "engine/dem/compress.h"

#include "engine/base/files.h"
#include "engine/dem/fire.h"
#include "engine/dem/overlap_forces.h"
#include "engine/dem/state_file.h"
#include "engine/search/spatial_order.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

namespace tamp {

namespace {

/// Margin of the neighbour list in radii.
constexpr double kSkin = 0.1;

/// Steps in units of the inverse frequency that the masses set. With m = Σ k over the contacts of a sphere the highest
/// frequency is √2 (|u_i − u_j|² ≤ 2 u_i² + 2 u_j²), the longest stable step √2; the rest is for contacts that form
/// between two updates of the masses.
constexpr double kFirstStep = 0.1;
constexpr double kLongestStep = 1.0;
constexpr double kShortestStep = 0.02;

/// Evaluations between updates of the masses.
constexpr std::int64_t kMassEvery = 20;
/// Contacts whose stiffness a sphere or the box has at least: those of a free sphere are to come.
constexpr double kLeastContacts = 2;

/// No sphere moves further than this share of its radius in one step.
constexpr double kLongestMove = 0.3;

/// Pressures fall by this factor; the last one is chosen to take the deepest overlap to this share of the tolerance.
/// Falls much deeper open most contacts, which then come back one by one.
constexpr double kPressureDrop = 3;
constexpr double kAim = 0.8;

/// A stage is over when the rms net force is below this many mean contact forces and the pressure within this share.
constexpr double kBalanced = 2e-2;
constexpr double kPressureReached = 0.05;
/// It is also over when the volume changed by less than the task's share within a window of so many evaluations, but
/// not before so many evaluations: the first to answer a new pressure is the box, not the spheres.
constexpr std::int64_t kWindow = 100;
constexpr std::int64_t kLeastStage = 400;
constexpr double kManyStrains = 1e9; // nothing is known yet
/// Evaluations for balance alone, once the overlaps are within the tolerance; and for everything.
constexpr std::int64_t kPatience = 1000;
constexpr std::int64_t kMostEvaluations = 200000;

/// Mean overlaps of jammed spheres in units of pressure are about 6 (measured, equal and lognormal spheres). The box is
/// widened to a prescribed packing fraction when that opens gaps of this many pressures.
constexpr double kOpened = 12;
/// Balance at which spheres in the widened box are held to be jammed.
constexpr double kJammed = 1e-3;

/// Evaluations after which the state can be written: the neighbour list is then made anew, so that its order is the
/// same for a run that goes on and for one that was cut off here.
constexpr std::int64_t kCheckpointEvery = 500;

template <int D>
double volume_of(const std::vector<double>& radii) {
  constexpr double unit = D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  double sum = 0;
  for (const double r : radii)
    sum += unit * std::pow(r, D);
  return sum;
}

template <int D>
class Compression {
public:
  explicit Compression(const CompressTask<D>& task)
      : task_(task), n_(task.radii.size()), solid_(volume_of<D>(task.radii)),
        order_(spatial_order<D>(task.size, task.positions)), radii_(sorted(task.radii, 1)),
        list_(all_periodic(), radii_, kSkin) {
    s_.positions = sorted(task.positions, D);
    s_.velocities.assign(n_ * D, 0);
    s_.masses.assign(n_, 0);
    s_.size = task.size;
    s_.pressure = task.pressure;
    forces_.resize(n_ * D);
    stiffness_.resize(n_);
  }

  Compressed<D> run() {
    resume();
    auto saved = std::chrono::steady_clock::now();
    for (;;) {
      if (s_.evaluations % kCheckpointEvery == 0) {
        const auto clock = std::chrono::steady_clock::now();
        if (!task_.checkpoint.empty() && s_.evaluations > 0 &&
            std::chrono::duration<double>(clock - saved).count() >= task_.checkpoint_every_s) {
          save();
          saved = clock;
        }
        if (task_.progress)
          task_.progress();
        list_.rebuild(s_.size, s_.positions);
      } else {
        list_.update(s_.size, s_.positions);
      }
      evaluate();
      if (const auto end = judge())
        return finish(*end);
      if (s_.stage_began < s_.evaluations) // else the forces are those of the stage before
        step();
    }
  }

private:
  /// Everything that the next step depends on.
  struct State {
    Vec<D> size;
    std::vector<double> positions;
    std::vector<double> velocities; // apart from the affine motion
    std::vector<double> masses;
    double box_velocity = 0; // of ε = ln L
    double box_mass = 0;
    double pressure = 0;
    double dt = kFirstStep;
    double mixing = Fire::kMixing;
    std::int64_t downhill = 0;
    std::int64_t evaluations = 0;
    std::int64_t stage_began = 0;
    std::int64_t patience = 0;    // evaluations since the overlaps came within the tolerance
    std::int64_t fixed = 0;       // 1: the box has the prescribed size
    double window_began = 0;      // logarithm of the volume when the window did
    double strain = kManyStrains; // change of that logarithm in the last whole window

    template <class Self, class F>
    static void for_each(Self& s, F&& f) {
      f(s.size);
      f(s.positions);
      f(s.velocities);
      f(s.masses);
      f(s.box_velocity);
      f(s.box_mass);
      f(s.pressure);
      f(s.dt);
      f(s.mixing);
      f(s.downhill);
      f(s.evaluations);
      f(s.stage_began);
      f(s.patience);
      f(s.fixed);
      f(s.window_began);
      f(s.strain);
    }
  };

  /// Sums of one pass over the spheres.
  struct Motion {
    double power = 0;   // F·v
    double force = 0;   // F²
    double scaled = 0;  // F²/m
    double kinetic = 0; // m v²
    double touched = 0; // spheres with a force
    void operator+=(const Motion& other) {
      power += other.power;
      force += other.force;
      scaled += other.scaled;
      kinetic += other.kinetic;
      touched += other.touched;
    }
  };

  static std::array<bool, D> all_periodic() {
    std::array<bool, D> periodic;
    periodic.fill(true);
    return periodic;
  }

  [[nodiscard]] std::vector<double> sorted(const std::vector<double>& numbers, std::size_t each) const {
    std::vector<double> result(numbers.size());
    for (std::size_t i = 0; i < n_; ++i)
      std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(order_[i] * each), each,
                  result.begin() + static_cast<std::ptrdiff_t>(i * each));
    return result;
  }

  /// Widens the box to the prescribed packing fraction.
  void fix_box() {
    const double factor = std::pow(present_phi() / task_.target_phi, 1.0 / D);
    s_.size *= factor;
    for (double& x : s_.positions)
      x *= factor;
    s_.fixed = 1;
  }

  /// Goes on at another pressure, from rest.
  void begin_stage(double pressure) {
    s_.pressure = pressure;
    s_.stage_began = s_.evaluations;
    s_.strain = kManyStrains;
    std::fill(s_.velocities.begin(), s_.velocities.end(), 0.0);
    s_.box_velocity = 0;
    s_.mixing = Fire::kMixing;
    s_.downhill = 0;
  }

  [[nodiscard]] Eigen::Map<const Vec<D>> force(std::size_t i) const {
    return Eigen::Map<const Vec<D>>(forces_.data() + i * D);
  }
  [[nodiscard]] Eigen::Map<Vec<D>> velocity(std::size_t i) { return Eigen::Map<Vec<D>>(s_.velocities.data() + i * D); }
  [[nodiscard]] Eigen::Map<Vec<D>> position(std::size_t i) { return Eigen::Map<Vec<D>>(s_.positions.data() + i * D); }

  [[nodiscard]] double present_pressure() const { return sums_.virial / (D * s_.size.prod()); }
  [[nodiscard]] double present_phi() const { return solid_ / s_.size.prod(); }

  void evaluate() {
    const bool weigh = s_.evaluations % kMassEvery == 0;
    sums_ = kernel_.evaluate(list_, s_.positions, radii_, forces_, weigh ? stiffness_ : std::span<double>{});
    ++s_.evaluations;
    if (weigh) {
      parallel_for(n_, [&](std::size_t i) {
        s_.masses[i] = std::max(stiffness_[i], kLeastContacts * Harmonic<D>::stiffness(radii_[i]));
      });
      // A free sphere's share of Σ k d²: two contacts of its own kind; k d² is of the order of its volume.
      s_.box_mass = std::max(sums_.stretch, kLeastContacts * solid_ / std::numbers::pi);
    }
    motion_ = parallel_sum<Motion>(n_, [&](std::size_t i) {
      const double squared = force(i).squaredNorm();
      return Motion{force(i).dot(velocity(i)), squared, squared / s_.masses[i],
                    s_.masses[i] * velocity(i).squaredNorm(), squared > 0 ? 1.0 : 0.0};
    });
    box_force_ = s_.fixed != 0 ? 0 : sums_.virial - D * s_.pressure * s_.size.prod();
    motion_.power += box_force_ * s_.box_velocity;
    motion_.scaled += box_force_ * box_force_ / s_.box_mass;
    motion_.kinetic += s_.box_mass * s_.box_velocity * s_.box_velocity;
    const double mean = sums_.contacts > 0 ? sums_.force / sums_.contacts : 0;
    balance_ = mean > 0 ? std::sqrt(motion_.force / motion_.touched) / mean : std::numeric_limits<double>::infinity();
  }

  /// How the run ends, if it does; else goes to the next stage when the present one is over.
  std::optional<CompressEnd> judge() {
    if (s_.evaluations % kWindow == 0) {
      const double now = std::log(s_.size.prod());
      s_.strain = s_.evaluations - s_.stage_began >= kWindow ? std::abs(now - s_.window_began) : kManyStrains;
      s_.window_began = now;
    }
    const bool shallow = sums_.deepest <= task_.overlap;
    const bool prescribed = !std::isnan(task_.target_phi);
    if (s_.fixed != 0) {
      if (shallow)
        return CompressEnd::done;
      if (balance_ < kJammed)
        return CompressEnd::jammed;
    } else if (std::abs(present_pressure() / s_.pressure - 1) < kPressureReached) {
      const bool balanced = balance_ < kBalanced;
      const bool at_rest = s_.strain < task_.stop_strain && s_.evaluations - s_.stage_began >= kLeastStage;
      s_.patience = shallow ? s_.patience + 1 : 0;
      if (prescribed && (balanced || at_rest)) {
        if (present_phi() < task_.target_phi)
          return CompressEnd::jammed;
        const double opened = 2 * (std::pow(present_phi() / task_.target_phi, 1.0 / D) - 1);
        const bool enough = opened > kOpened * s_.pressure;
        begin_stage(s_.pressure / kPressureDrop);
        if (enough)
          fix_box();
      } else if (shallow && (balanced || s_.patience > kPatience)) {
        return CompressEnd::done;
      } else if (!shallow && (balanced || at_rest)) {
        begin_stage(std::max(s_.pressure / kPressureDrop, s_.pressure * kAim * task_.overlap / sums_.deepest));
      }
    }
    if (s_.evaluations >= kMostEvaluations)
      return CompressEnd::gave_up;
    return std::nullopt;
  }

  void step() {
    if (motion_.power > 0) {
      if (++s_.downhill > Fire::kDelay) {
        s_.dt = std::min(s_.dt * Fire::kGrow, kLongestStep);
        s_.mixing *= Fire::kMixingDecay;
      }
    } else {
      if (s_.downhill > 0)
        s_.dt = std::max(s_.dt * Fire::kShrink, kShortestStep);
      s_.downhill = 0;
      s_.mixing = Fire::kMixing;
      parallel_for(n_, [&](std::size_t i) {
        position(i) -= 0.5 * s_.dt * velocity(i);
        velocity(i).setZero();
      });
      s_.box_velocity = 0;
      motion_.kinetic = 0;
    }
    // v ← (1 − α) v + α |v| a/|a| + dt a in the metric of the masses.
    const double turn = motion_.scaled > 0 ? s_.mixing * std::sqrt(motion_.kinetic / motion_.scaled) : 0;
    const double push = turn + s_.dt;
    const double most = task_.rate / s_.dt;
    s_.box_velocity = (1 - s_.mixing) * s_.box_velocity + push / s_.box_mass * box_force_;
    s_.box_velocity = std::clamp(s_.box_velocity, -most, most);
    const double factor = std::exp(s_.dt * s_.box_velocity);
    s_.size *= factor;
    parallel_for(n_, [&](std::size_t i) {
      if (force(i).isZero(0)) {
        velocity(i).setZero(); // a rattler only follows the box
        position(i) *= factor;
        return;
      }
      velocity(i) = (1 - s_.mixing) * velocity(i) + push / s_.masses[i] * force(i);
      Vec<D> move = s_.dt * velocity(i);
      const double longest = kLongestMove * radii_[i];
      if (const double length = move.norm(); length > longest)
        move *= longest / length;
      position(i) = factor * position(i) + move;
    });
  }

  Compressed<D> finish(CompressEnd end) {
    list_.rebuild(s_.size, s_.positions); // wraps
    Compressed<D> result;
    result.end = end;
    result.size = s_.size;
    result.positions.resize(n_ * D);
    for (std::size_t i = 0; i < n_; ++i)
      std::copy_n(s_.positions.begin() + static_cast<std::ptrdiff_t>(i * D), D,
                  result.positions.begin() + static_cast<std::ptrdiff_t>(std::size_t{order_[i]} * D));
    result.phi = present_phi();
    result.overlap = sums_.deepest;
    result.nearest = sums_.nearest;
    result.pressure = present_pressure();
    result.force_balance = balance_;
    result.evaluations = s_.evaluations;
    result.list_rebuilds = static_cast<std::int64_t>(list_.rebuilds());
    result.list_repairs = static_cast<std::int64_t>(list_.repairs());
    return result;
  }

  void save() const {
    ByteWriter out;
    State::for_each(s_, [&](const auto& value) { out.put(value); });
    write_atomically(task_.checkpoint, out.bytes());
  }

  void resume() {
    std::error_code none;
    if (task_.checkpoint.empty() || !std::filesystem::exists(task_.checkpoint, none))
      return;
    const std::string bytes = read_file(task_.checkpoint);
    ByteReader in(bytes);
    State read;
    State::for_each(read, [&](auto& value) { in.get(value); });
    if (in.good && in.at_end() && read.positions.size() == n_ * D && read.velocities.size() == n_ * D &&
        read.masses.size() == n_)
      s_ = std::move(read);
  }

  const CompressTask<D>& task_;
  std::size_t n_;
  double solid_; // volume of the spheres
  std::vector<std::uint32_t> order_;
  std::vector<double> radii_;
  NeighbourList<D> list_;
  OverlapForces<D> kernel_;
  State s_;
  std::vector<double> forces_;
  std::vector<double> stiffness_;
  ContactSums sums_;
  Motion motion_;
  double box_force_ = 0;
  double balance_ = 0;
};

} // namespace

template <int D>
Compressed<D> compress(const CompressTask<D>& task) {
  return Compression<D>(task).run();
}

template Compressed<2> compress(const CompressTask<2>&);
template Compressed<3> compress(const CompressTask<3>&);

} // namespace tamp
