// The drive of isostatic compression with friction or adhesion: quasi-static motion of the spheres and of the box.
//
// Inertia decides nothing here but the time it takes: spheres have the inertia that one long step asks for at the
// present stiffness of their contacts (scaled_inertia.h), and so has the box. Varied are places x = L u and ε = ln L,
// −∂H/∂ε = Σ f·d − D p V as in compress.cpp; local damping takes energy from both. The pressure p is a physical load:
// it is what adhesion is measured against, and stays. Contacts become stiffer at the same load until they overlap
// little enough.
#pragma once

#include "engine/base/files.h"
#include "engine/dem/compress.h"
#include "engine/dem/scaled_inertia.h"
#include "engine/dem/state_file.h"
#include "engine/dem/verlet.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace tamp {

/// Steps between two looks at pressure, balance and strain.
inline constexpr std::int64_t kPressWatch = 100;
/// Local damping, and the share of all motion lost whenever inertia is matched, as in settling.
inline constexpr double kPressDamping = 0.25;
inline constexpr double kPressSlowing = 0.01;
inline constexpr std::int64_t kPressMatch = 20;
/// A stage is over when the pressure is within this share of the load, the forces of the spheres touched balance as the
/// task asks, and the box rests.
inline constexpr double kPressReached = 0.02;
/// Contacts become stiffer by at most this factor at once; the last time they aim at this share of the tolerated
/// overlap. After so many times without a smaller overlap they are left as they are.
inline constexpr double kPressStiffening = 4;
inline constexpr double kPressAim = 0.9;
inline constexpr int kPressFutile = 6;
/// A box held at a prescribed packing fraction bears nothing below this share of the load: its spheres are apart.
inline constexpr double kUnloaded = 1e-3;
/// Steps are unstable if all energy together rose between two looks by this share of the larger kinetic and contact
/// energies; rounding of p V, relative to it, is no alarm. They are then halved (inertia four times larger) and redone.
inline constexpr double kPressAlarm = 0.2;
inline constexpr double kPressRounding = 1e-11;
inline constexpr std::int64_t kMostPressHalvings = 12;
inline constexpr std::int64_t kMostPressSteps = 400000;
/// Margin of the near list in median radii.
inline constexpr double kPressSkin = 0.3;

template <int D, class Law>
class PressRun {
public:
  /// make_law(E*): the contact law at a stiffness.
  template <class MakeLaw>
  PressRun(const CompressTask<D>& task, MakeLaw make_law)
      : task_(task), make_law_(std::move(make_law)), size_(task.size), modulus_(task.modulus), state_(start(task)),
        field_(make_law_(task.modulus), box(task.size), skin(task)) {
    for (const double r : task.radii)
      solid_ += (D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3) * std::pow(r, D);
  }

  Compressed<D> run() {
    if (!resume())
      evaluate(0);
    Look last = look();
    PressRun good = *this;
    auto saved = std::chrono::steady_clock::now();
    for (;;) {
      for (std::int64_t k = 0; k < kPressWatch; ++k) {
        if (k % kPressMatch == 0) {
          match();
          slow_down(state_, kPressSlowing, 1); // what touches nothing only goes along with the box
        }
        step();
      }
      steps_ += kPressWatch;
      const Look now = look();
      if (unstable(last, now) && halvings_ < kMostPressHalvings) {
        good.steps_ = steps_;
        ++good.halvings_;
        *this = good;
        continue;
      }
      if (const auto end = judge(now))
        return finish(*end, now);
      last = look(); // contacts may be stiffer now
      good = *this;
      const auto clock = std::chrono::steady_clock::now();
      if (!task_.checkpoint.empty() &&
          std::chrono::duration<double>(clock - saved).count() >= task_.checkpoint_every_s) {
        save();
        saved = clock;
      }
      if (task_.progress)
        task_.progress();
    }
  }

private:
  struct Look {
    ContactSummary contacts;
    double balance = 0;
    double pressure = 0;
    double strain = 0;  // of the volume since the last look
    double kinetic = 0; // of spheres and box
    double total = 0;   // with contacts and p V
  };

  static State<D, Law> start(const CompressTask<D>& task) {
    std::vector<Vec<D>> centres(task.radii.size());
    for (std::size_t i = 0; i < centres.size(); ++i)
      centres[i] = Eigen::Map<const Vec<D>>(task.positions.data() + i * D);
    return at_rest<D, Law>(centres, task.radii, std::vector<double>(centres.size(), 1.0), 0);
  }
  static SearchBox<D> box(const Vec<D>& size) {
    SearchBox<D> box;
    box.size = size;
    box.periodic.fill(true);
    return box;
  }
  static double skin(const CompressTask<D>& task) {
    std::vector<double> radii = task.radii;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return kPressSkin * *middle;
  }

  [[nodiscard]] double volume() const { return size_.prod(); }
  [[nodiscard]] double phi() const { return solid_ / volume(); }
  [[nodiscard]] bool prescribed() const { return !std::isnan(task_.target_phi); }
  [[nodiscard]] double pressure() const { return virial_ / (D * volume()); }

  /// What pushes ε.
  [[nodiscard]] double stretch_force() const { return fixed_ != 0 ? 0 : virial_ - D * task_.load * volume(); }

  void evaluate(double dt) {
    field_.evaluate(state_, dt);
    virial_ = field_.virial();
  }

  /// Inertia for a step of length 1 of spheres and box.
  void match() {
    // A contact must be expected to bear the load on a sphere's cross-section, and to pull with 2πWR.
    const double dt = std::pow(0.5, static_cast<double>(halvings_));
    match_inertia(state_, field_, 1 / dt, [&](std::size_t i) {
      const double r = state_.radius[i];
      return task_.load * std::pow(r, D - 1) + std::numbers::pi * task_.adhesion * r;
    });
    // At least what the load itself will set against a stretch once contacts bear it: Σ k d² with k d ~ 2 f/δ d.
    const double least = D * D * task_.load * volume() * std::pow(field_.law().normal.modulus / task_.load, 2.0 / 3);
    const double inertia = kInertiaMargin * 0.5 / (dt * dt) * std::max(field_.stretch_stiffness(state_), least);
    if (box_inertia_ > 0)
      box_velocity_ *= std::sqrt(box_inertia_ / inertia);
    box_inertia_ = inertia;
  }

  void kick_box() { box_velocity_ += 0.5 / box_inertia_ * damping_(stretch_force(), box_velocity_); }

  /// verlet_step() with a box that shrinks or grows; spheres go along with it.
  void step() {
    kick(state_, 0.5, damping_);
    kick_box();
    box_velocity_ = std::clamp(box_velocity_, -task_.rate, task_.rate);
    double factor = std::exp(box_velocity_);
    if (prescribed() && fixed_ == 0 && phi() / std::pow(factor, D) >= task_.target_phi) {
      factor = std::pow(phi() / task_.target_phi, 1.0 / D);
      fixed_ = 1;
      box_velocity_ = 0;
    }
    size_ *= factor;
    field_.resize(size_);
    parallel_for(state_.count(),
                 [&](std::size_t i) { state_.centre[i] = factor * state_.centre[i] + state_.velocity[i]; });
    evaluate(1);
    kick(state_, 0.5, damping_);
    kick_box();
  }

  [[nodiscard]] Look look() {
    Look l;
    l.contacts = field_.summary(state_);
    struct Net {
      double squared = 0;
      double touched = 0;
      void operator+=(const Net& other) {
        squared += other.squared;
        touched += other.touched;
      }
    };
    const Net net = parallel_sum<Net>(state_.count(), [&](std::size_t i) {
      const double squared = state_.force[i].squaredNorm();
      return Net{squared, squared > 0 ? 1.0 : 0.0};
    });
    const double mean = l.contacts.contacts > 0 ? l.contacts.force / l.contacts.contacts : 0;
    l.balance = mean > 0 ? std::sqrt(net.squared / net.touched) / mean : std::numeric_limits<double>::infinity();
    l.pressure = pressure();
    l.kinetic = kinetic_energy(state_) + 0.5 * box_inertia_ * box_velocity_ * box_velocity_;
    l.total = l.kinetic + l.contacts.energy + (fixed_ == 0 ? task_.load * volume() : 0);
    l.strain = std::abs(std::log(volume() / last_volume_));
    last_volume_ = volume();
    return l;
  }

  /// Whether energy came from nowhere: a step too long for the contacts that formed in it.
  [[nodiscard]] static bool unstable(const Look& before, const Look& now) {
    const double moving = std::max(before.kinetic, now.kinetic) +
                          std::max(std::abs(before.contacts.energy), std::abs(now.contacts.energy));
    return !(now.total <= before.total + kPressAlarm * moving + kPressRounding * std::abs(before.total));
  }

  /// How the run ends, if it does; else makes contacts stiffer when a stage is over.
  std::optional<CompressEnd> judge(const Look& l) {
    const bool apart = fixed_ != 0 && l.pressure < kUnloaded * task_.load && l.contacts.overlap <= task_.overlap;
    const bool rests =
        l.balance <= task_.force_balance &&
        (fixed_ != 0 || (std::abs(l.pressure / task_.load - 1) <= kPressReached && l.strain < task_.stop_strain));
    if (apart)
      return CompressEnd::done;
    if (rests) {
      if (l.contacts.overlap <= task_.overlap || !can_stiffen())
        return prescribed() && fixed_ == 0           ? CompressEnd::jammed
               : l.contacts.overlap <= task_.overlap ? CompressEnd::done
                                                     : CompressEnd::gave_up;
      stiffen(l);
    }
    if (steps_ >= kMostPressSteps)
      return CompressEnd::gave_up;
    return std::nullopt;
  }

  [[nodiscard]] bool can_stiffen() const { return modulus_ < task_.largest_modulus && futile_ < kPressFutile; }

  void stiffen(const Look& l) {
    ++stiffenings_;
    futile_ = l.contacts.overlap < least_overlap_ ? 0 : futile_ + 1;
    least_overlap_ = std::min(least_overlap_, l.contacts.overlap);
    // Under the same force δ ∝ E*^{−2/3}.
    modulus_ = std::min(
        task_.largest_modulus,
        modulus_ * std::min(kPressStiffening, std::pow(l.contacts.overlap / (kPressAim * task_.overlap), 1.5)));
    field_.set_law(make_law_(modulus_), state_);
    evaluate(0);
  }

  Compressed<D> finish(CompressEnd end, const Look& l) {
    Compressed<D> result;
    result.end = end;
    result.size = size_;
    for (const Vec<D>& c : state_.centre) {
      for (int a = 0; a < D; ++a) {
        double x = c[a] - size_[a] * std::floor(c[a] / size_[a]);
        result.positions.push_back(x < size_[a] ? x : 0); // a tiny negative number rounds up to the edge
      }
    }
    result.phi = phi();
    result.overlap = l.contacts.overlap;
    result.pressure = l.pressure;
    result.force_balance = l.balance;
    result.evaluations = steps_;
    result.list_rebuilds = static_cast<std::int64_t>(field_.rebuilds());
    result.modulus = modulus_;
    result.stiffenings = stiffenings_;
    result.halvings = halvings_;
    return result;
  }

  template <class F>
  void for_each_number(F&& f) {
    for (int a = 0; a < D; ++a)
      f(size_[a]);
    f(modulus_);
    f(box_velocity_);
    f(box_inertia_);
    f(virial_);
    f(last_volume_);
    f(least_overlap_);
    f(steps_);
    f(stiffenings_);
    f(futile_);
    f(halvings_);
    f(fixed_);
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
    PressRun fresh = *this;
    for_each_number([&](auto& number) { in.get(number); });
    field_.resize(size_);
    field_.set_law(make_law_(modulus_), state_);
    if constexpr (Law::turns)
      state_.gyration = kMatchedGyration;
    if (in.good && read_state(in, state_, field_))
      return true;
    *this = std::move(fresh);
    return false;
  }

  CompressTask<D> task_;
  std::function<Law(double)> make_law_;
  Vec<D> size_;
  double modulus_;
  State<D, Law> state_;
  ForceField<D, Law, Pressing> field_;
  LocalDamping damping_{kPressDamping};
  double solid_ = 0;
  double virial_ = 0;
  double box_velocity_ = 0; // of ε
  double box_inertia_ = 0;
  double last_volume_ = std::numeric_limits<double>::infinity();
  double least_overlap_ = std::numeric_limits<double>::infinity();
  std::int64_t steps_ = 0;
  std::int64_t stiffenings_ = 0;
  std::int64_t futile_ = 0;
  std::int64_t halvings_ = 0;
  std::int64_t fixed_ = 0; // 1: the box has its prescribed size
};

} // namespace tamp
