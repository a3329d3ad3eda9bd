// The drive of a settling run: steps, the watch over their stability, rest, stiffening, and the file to go on from.
#pragma once

#include "engine/base/files.h"
#include "engine/dem/scaled_inertia.h"
#include "engine/dem/settle.h"
#include "engine/dem/state_file.h"
#include "engine/dem/time_step.h"
#include "engine/dem/verlet.h"

#include <chrono>
#include <optional>

namespace tamp {

/// Steps between two looks at energy, overlap and rest.
inline constexpr int kWatchSteps = 100;
/// A step is unstable if the whole energy rose between two looks by more than this share of the larger kinetic and
/// contact energies (friction can give back what its springs hold: less), or if an overlap went beyond kDeepest radii.
inline constexpr double kEnergyAlarm = 0.2;
inline constexpr double kDeepest = 0.5;
/// Rounding of the height energy, relative to it, that is no alarm.
inline constexpr double kEnergyRounding = 1e-11;
/// Looks with little motion in which the imbalance of forces must have halved.
inline constexpr int kStillLooks = 200;
/// Steps after which a bed is given up.
inline constexpr std::int64_t kMostSteps = 3000000;
/// Halvings after which a run is given up.
inline constexpr int kMostHalvings = 12;
/// Stiffenings after which a bed is left as it is. Contacts become stiffer by at most this factor at once, so that the
/// bed is not thrown up by what they held; the last one aims at this share of the tolerated overlap. A stage is over
/// when forces balance to this share of the mean contact force.
inline constexpr int kMostStiffenings = 40;
inline constexpr double kStiffening = 2;
inline constexpr double kStiffenAim = 0.9;
inline constexpr double kStageBalance = 2e-2;
/// Stiffening is given up after so many times without an overlap below this share of the least one so far: spheres that
/// friction holds wedged between their own images stay so, however stiff.
inline constexpr int kFutileStiffenings = 6;
inline constexpr double kLessOverlap = 0.95;
/// A bed whose spheres have two contacts on average and less than this mean kinetic energy (in weight times mean
/// radius) has its shape; what is left are waves, which contacts hardly damp. From then on inertia is matched to the
/// stiffness of contacts, every so many steps, and motion is damped by this share of the forces.
inline constexpr double kShapedKinetic = 0.2;
inline constexpr int kMatchSteps = 20;
inline constexpr double kLocalDamping = 0.25;
/// Beside that, spheres lose this share of their motion whenever inertia is matched: rattlers that roll and turn
/// freely.
inline constexpr double kSlowing = 0.01;
/// Margin of the near list in median radii: a wider one makes the list longer, a narrower one due more often.
inline constexpr double kSkin = 0.3;

template <int D, class Law>
class SettleRun {
public:
  /// make_law(E*): the contact law at a stiffness.
  template <class MakeLaw>
  SettleRun(const SettleTask<D>& task, MakeLaw make_law)
      : task_(task), make_law_(std::move(make_law)),
        state_(at_rest<D, Law>(task.centres, task.radii, task.masses, task.gravity)),
        field_(make_law_(task.modulus), task.box, skin(task)) {
    if constexpr (Law::turns) {
      if (task.gyration > 0)
        state_.gyration = task.gyration;
    }
    double top = 0;
    for (const Vec<D>& c : task.centres)
      top = std::max(top, c[vertical<D>]);
    fall_time_ = std::sqrt(2 * top / task.gravity);
    for (const double m : task.masses)
      weight_ += m * task.gravity;
    for (const double r : task.radii)
      mean_radius_ += r / static_cast<double>(task.radii.size());
    result_.modulus = task.modulus;
    make_fines_denser(state_);
    dt_ = stable_step();
  }

  Settled<D> run() {
    if (!resume())
      field_.evaluate(state_, 0);
    Look last = look();
    auto saved = std::chrono::steady_clock::now();
    remember();
    while (!done(last)) {
      advance();
      result_.steps += kWatchSteps;
      const Look now = look();
      if (unstable(last, now) || jitters(now)) {
        const bool deep = falling() && !(now.contacts.overlap <= kDeepest);
        restore();
        if (deep && stiffen(last)) { // a small sphere between large ones, not a step too long
          last = look();
          remember();
          continue;
        }
        if (result_.halvings == kMostHalvings)
          return finish(last, false);
        ++result_.halvings;
        dt_ /= 2;
        good_dt_ = dt_;
        continue;
      }
      last = now;
      if (falling())
        elapsed_ += kWatchSteps * dt_;
      if (falling() && has_shape(last)) {
        leave_the_fall();
        last = look();
      } else if (!falling() && last.balance <= std::max(kStageBalance, task_.force_balance) &&
                 last.contacts.overlap > task_.overlap && stiffen(last)) {
        last = look();
      }
      remember();
      const auto clock = std::chrono::steady_clock::now();
      if (!task_.checkpoint.empty() &&
          std::chrono::duration<double>(clock - saved).count() >= task_.checkpoint_every_s) {
        save();
        saved = clock;
      }
      if (task_.progress)
        task_.progress(std::min(1.0, task_.force_balance / std::max(last.balance, task_.force_balance)));
    }
    return finish(last, at_rest_now(last));
  }

private:
  struct Look {
    ContactSummary contacts;
    double kinetic = 0;
    double total = 0;
    double balance = 0;
  };
  static double skin(const SettleTask<D>& task) {
    std::vector<double> radii = task.radii;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return kSkin * *middle;
  }

  [[nodiscard]] double stable_step() const {
    const double speed = task_.gravity * fall_time_; // no sphere meets another faster than by a fall from the top
    return tamp::stable_step(state_.radius, state_.mass, result_.modulus, speed, task_.overlap,
                             task_.steps_per_collision > 0 ? task_.steps_per_collision : kStepsPerCollision);
  }

  /// The fall is followed in time; what comes after it has none.
  [[nodiscard]] bool falling() const { return matched_dt_ == 0; }

  void advance() {
    for (int k = 0; k < kWatchSteps; ++k) {
      if (falling()) {
        verlet_step(state_, field_, dt_);
        continue;
      }
      if (k % kMatchSteps == 0) {
        match_inertia();
        slow_down(state_, kSlowing, kFloatSlowing);
      }
      verlet_step(state_, field_, dt_, LocalDamping{kLocalDamping});
    }
  }

  void leave_the_fall() {
    matched_dt_ = dt_;
    land_floating(state_, field_.box());
    for (std::size_t i = 0; i < state_.count(); ++i)
      state_.weight[i] = task_.masses[i] * task_.gravity;
    field_.evaluate(state_, 0);
    match_inertia();
    field_.evaluate(state_, 0);
  }

  void match_inertia() {
    tamp::match_inertia(state_, field_, matched_dt_, [this](std::size_t i) { return state_.weight[i]; });
  }

  [[nodiscard]] Look look() const {
    Look l;
    l.contacts = field_.summary(state_);
    l.kinetic = kinetic_energy(state_);
    l.total = l.kinetic + l.contacts.energy + parallel_sum<double>(state_.count(), [&](std::size_t i) {
                return state_.weight[i] * state_.centre[i][vertical<D>];
              });
    const double net =
        parallel_sum<double>(state_.count(), [&](std::size_t i) { return state_.force[i].squaredNorm(); });
    const double mean_contact = l.contacts.contacts > 0 ? l.contacts.force / l.contacts.contacts : 0;
    l.balance = mean_contact > 0 ? std::sqrt(net / static_cast<double>(state_.count())) / mean_contact
                                 : std::numeric_limits<double>::infinity();
    return l;
  }

  [[nodiscard]] bool unstable(const Look& before, const Look& now) const {
    const double moving = std::max(before.kinetic, now.kinetic) +
                          std::max(std::abs(before.contacts.energy), std::abs(now.contacts.energy));
    const double allowed = kEnergyAlarm * moving + kEnergyRounding * std::abs(before.total);
    const bool energy = !(now.total <= before.total + allowed); // NaN is an alarm
    return energy || !(now.contacts.overlap <= std::max(kDeepest, before.contacts.overlap));
  }

  /// Whether forces have stayed out of balance for long though nearly nothing moves: what a step does that is just too
  /// long for the fastest contact, whose swing then neither grows nor dies.
  bool jitters(const Look& now) {
    if (mean_kinetic(now) > task_.kinetic_energy || at_rest_now(now)) {
      still_looks_ = 0;
      return false;
    }
    if (still_looks_++ == 0)
      still_balance_ = now.balance;
    if (still_looks_ < kStillLooks)
      return false;
    still_looks_ = 0;
    return now.balance > still_balance_ / 2;
  }

  [[nodiscard]] double mean_kinetic(const Look& l) const { return l.kinetic / (weight_ * mean_radius_); }

  [[nodiscard]] bool has_shape(const Look& l) const {
    return l.contacts.contacts >= static_cast<double>(state_.count()) && mean_kinetic(l) <= kShapedKinetic;
  }

  [[nodiscard]] bool at_rest_now(const Look& l) const {
    return l.balance <= task_.force_balance && mean_kinetic(l) <= task_.kinetic_energy;
  }

  [[nodiscard]] bool done(const Look& l) const {
    if (elapsed_ > task_.longest * fall_time_ || result_.steps > kMostSteps)
      return true;
    return at_rest_now(l) && (l.contacts.overlap <= task_.overlap || !can_stiffen());
  }

  [[nodiscard]] bool can_stiffen() const {
    return result_.modulus < task_.largest_modulus && result_.stiffenings < kMostStiffenings &&
           futile_ < kFutileStiffenings;
  }

  bool stiffen(const Look& l) {
    if (!can_stiffen())
      return false;
    ++result_.stiffenings;
    futile_ = l.contacts.overlap < kLessOverlap * least_overlap_ ? 0 : futile_ + 1;
    least_overlap_ = std::min(least_overlap_, l.contacts.overlap);
    // Under the same force δ ∝ E*^{−2/3}.
    result_.modulus = std::min(
        task_.largest_modulus,
        result_.modulus * std::min(kStiffening, std::pow(l.contacts.overlap / (kStiffenAim * task_.overlap), 1.5)));
    field_.set_law(make_law_(result_.modulus), state_);
    if (falling())
      dt_ = std::min(dt_, stable_step());
    else
      match_inertia();
    field_.evaluate(state_, 0);
    return true;
  }

  void remember() {
    good_state_ = state_;
    good_field_ = field_;
    good_dt_ = dt_;
  }
  void restore() {
    state_ = good_state_;
    field_ = good_field_;
    dt_ = good_dt_;
  }

  template <class F>
  void for_each_number(F&& f) {
    f(elapsed_);
    f(still_looks_);
    f(still_balance_);
    f(result_.modulus);
    f(result_.steps);
    f(result_.halvings);
    f(result_.stiffenings);
    f(dt_);
    f(matched_dt_);
    f(futile_);
    f(least_overlap_);
  }

  void save() {
    ByteWriter out;
    for_each_number([&](const auto& number) { out.put(number); });
    write_state(out, state_, field_);
    write_atomically(task_.checkpoint, out.bytes());
  }

  bool resume() {
    std::error_code none;
    if (task_.checkpoint.empty() || !std::filesystem::exists(task_.checkpoint, none))
      return false;
    const std::string bytes = read_file(task_.checkpoint);
    ByteReader in(bytes);
    SettleRun fresh = *this;
    for_each_number([&](auto& number) { in.get(number); });
    field_.set_law(make_law_(result_.modulus), state_);
    if constexpr (Law::turns) {
      if (!falling())
        state_.gyration = kMatchedGyration;
    }
    if (in.good && read_state(in, state_, field_))
      return true;
    *this = std::move(fresh);
    return false;
  }

  Settled<D> finish(const Look& l, bool rests) {
    result_.centres = state_.centre;
    result_.at_rest = rests;
    result_.overlap = l.contacts.overlap;
    result_.force_balance = l.balance;
    result_.kinetic_energy = mean_kinetic(l);
    result_.step = dt_;
    result_.list_rebuilds = static_cast<std::int64_t>(field_.rebuilds());
    return result_;
  }

  SettleTask<D> task_;
  std::function<Law(double)> make_law_;
  State<D, Law> state_;
  ForceField<D, Law> field_;
  State<D, Law> good_state_ = state_; // of the last good look
  ForceField<D, Law> good_field_ = field_;
  double good_dt_ = 0;
  Settled<D> result_;
  double dt_ = 0;
  double matched_dt_ = 0;   // what inertia is matched to; 0 in the fall
  std::int64_t futile_ = 0; // stiffenings since the least overlap
  double least_overlap_ = std::numeric_limits<double>::infinity();
  double elapsed_ = 0;
  std::int64_t still_looks_ = 0; // for how many looks there has been little motion, and the balance at the first
  double still_balance_ = 0;
  double fall_time_ = 0;
  double weight_ = 0;
  double mean_radius_ = 0;
};

} // namespace tamp
