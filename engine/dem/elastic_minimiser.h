// FIRE over the places of elastic spheres and one stretch of the whole packing together: what compression and settling
// without friction have in common.
//
// The spheres' places x and the logarithm ε of a stretch of all of them are varied together: the stretch is the longest
// wave, which would take the most steps if spheres moved one by one. Masses are what makes all frequencies of the order
// of one: of a sphere the stiffness of its contacts, of the stretch Σ k d².
#pragma once

#include "engine/base/files.h"
#include "engine/dem/fire.h"
#include "engine/dem/overlap_forces.h"
#include "engine/dem/state_file.h"
#include "engine/search/spatial_order.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace tamp {

/// Evaluations after which the state can be written. The neighbour list is then made anew, so
/// that its order is the same for a run that goes on and for one that was cut off there.
inline constexpr std::int64_t kCheckpointEvery = 500;

/// Law: of the contacts between spheres, as overlap_forces.h has them. Drive: what acts beside them:
///   kReweigh             whether masses must follow a contact as it forms, as its stiffness grows with the overlap;
///   stretches(axis)      whether ε stretches that axis;
///   Beside               sums over what act() adds, with +=;
///   act(i, x, F, k)      adds the force and the stiffness of walls and weight on sphere i at x;
///   mass(i, k)           of sphere i, whose contacts have the stiffness k together;
///   pull(sums, lever, size)  −∂/∂ε of what is minimised; lever: Σ F·x along the axes that stretch;
///   stretch_mass(sums)   mass of ε.
template <int D, class Law, class Drive>
class ElasticMinimiser {
public:
  /// Margin of the neighbour list in radii.
  static constexpr double kSkin = 0.1;
  /// Steps in units of the inverse frequency that the masses set. With m = Σ k over the contacts of a sphere the
  /// highest frequency is √2 (|u_i − u_j|² ≤ 2 u_i² + 2 u_j²), the longest stable step √2; the rest is for contacts
  /// that form between two updates of the masses.
  static constexpr double kFirstStep = 0.1;
  static constexpr double kLongestStep = 1.0;
  static constexpr double kShortestStep = 0.02;
  /// Evaluations between updates of the masses.
  static constexpr std::int64_t kMassEvery = 20;
  /// No sphere moves further than this share of its radius in one step.
  static constexpr double kLongestMove = 0.3;

  /// Everything that the next step depends on.
  struct State {
    Vec<D> size;
    std::vector<double> positions;
    std::vector<double> velocities; // apart from the affine motion
    std::vector<double> masses;
    double stretch_velocity = 0; // of ε
    double stretch_mass = 0;
    double dt = kFirstStep;
    double mixing = Fire::kMixing;
    std::int64_t downhill = 0;
    std::int64_t evaluations = 0;
  };

  /// positions: D numbers a sphere. size: the box; where an axis is not periodic it only sets the scale.
  ElasticMinimiser(const Vec<D>& size, const std::array<bool, D>& periodic, const std::vector<double>& positions,
                   const std::vector<double>& radii)
      : n_(radii.size()), order_(spatial_order<D>(size, positions)), radii_(sorted(radii, 1)),
        list_(periodic, radii_, kSkin) {
    s_.size = size;
    s_.positions = sorted(positions, D);
    s_.velocities.assign(n_ * D, 0);
    s_.masses.assign(n_, 0);
    forces_.resize(n_ * D);
    stiffness_.resize(n_);
  }

  [[nodiscard]] std::size_t count() const { return n_; }
  [[nodiscard]] State& state() { return s_; }
  [[nodiscard]] std::span<const double> radii() const { return radii_; }
  [[nodiscard]] const ContactSums& sums() const { return sums_; }
  [[nodiscard]] double balance() const { return balance_; } ///< rms net force of the spheres touched, in mean contacts
  [[nodiscard]] const NeighbourList<D>& list() const { return list_; }
  [[nodiscard]] Eigen::Map<Vec<D>> position(std::size_t i) { return Eigen::Map<Vec<D>>(s_.positions.data() + i * D); }

  /// Numbers of the spheres, `each` of them, in the order of the minimiser.
  [[nodiscard]] std::vector<double> sorted(const std::vector<double>& numbers, std::size_t each) const {
    std::vector<double> result(numbers.size());
    for (std::size_t i = 0; i < n_; ++i)
      std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(order_[i] * each), each,
                  result.begin() + static_cast<std::ptrdiff_t>(i * each));
    return result;
  }

  /// Positions in the order in which the spheres came; on periodic axes they are wrapped into the box.
  [[nodiscard]] std::vector<double> positions() {
    list_.rebuild(s_.size, s_.positions); // wraps
    std::vector<double> result(n_ * D);
    for (std::size_t i = 0; i < n_; ++i)
      std::copy_n(s_.positions.begin() + static_cast<std::ptrdiff_t>(i * D), D,
                  result.begin() + static_cast<std::ptrdiff_t>(std::size_t{order_[i]} * D));
    return result;
  }

  /// Brings the neighbour list up to date.
  void find_neighbours() {
    if (may_checkpoint())
      list_.rebuild(s_.size, s_.positions);
    else
      list_.update(s_.size, s_.positions);
  }
  [[nodiscard]] bool may_checkpoint() const { return s_.evaluations % kCheckpointEvery == 0; }

  /// Stops all motion.
  void rest() {
    std::fill(s_.velocities.begin(), s_.velocities.end(), 0.0);
    s_.stretch_velocity = 0;
    s_.mixing = Fire::kMixing;
    s_.downhill = 0;
  }

  /// Forces at the present places.
  void evaluate(const Law& law, const Drive& drive) {
    const bool weigh = s_.evaluations % kMassEvery == 0;
    sums_ = kernel_.evaluate(list_, s_.positions, radii_, forces_,
                             weigh || Drive::kReweigh ? stiffness_ : std::span<double>{}, law);
    ++s_.evaluations;
    motion_ = parallel_sum<Motion>(n_, [&](std::size_t i) {
      Motion m;
      m.beside = drive.act(i, position(i), force(i), stiffness_[i]);
      if (weigh || Drive::kReweigh)
        set_mass(s_.masses[i], drive.mass(i, stiffness_[i]), weigh, velocity(i));
      const double squared = force(i).squaredNorm();
      m.power = force(i).dot(velocity(i));
      m.force = squared;
      m.scaled = squared / s_.masses[i];
      m.kinetic = s_.masses[i] * velocity(i).squaredNorm();
      m.touched = squared > 0 ? 1.0 : 0.0;
      for (int a = 0; a < D; ++a)
        m.lever += Drive::stretches(a) ? force(i)[a] * position(i)[a] : 0.0;
      return m;
    });
    if constexpr (!std::is_empty_v<typename Drive::Beside>)
      sums_ += motion_.beside;
    stretch_force_ = drive.pull(sums_, motion_.lever, s_.size);
    if (weigh || Drive::kReweigh)
      set_mass(s_.stretch_mass, drive.stretch_mass(sums_), weigh, s_.stretch_velocity);
    motion_.power += stretch_force_ * s_.stretch_velocity;
    motion_.scaled += stretch_force_ * stretch_force_ / s_.stretch_mass;
    motion_.kinetic += s_.stretch_mass * s_.stretch_velocity * s_.stretch_velocity;
    const double mean = sums_.contacts > 0 ? sums_.force / sums_.contacts : 0;
    balance_ = mean > 0 ? std::sqrt(motion_.force / motion_.touched) / mean : std::numeric_limits<double>::infinity();
  }

  /// One step of FIRE; ε changes by at most `rate`.
  void step(double rate) {
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
      s_.stretch_velocity = 0;
      motion_.kinetic = 0;
    }
    // v ← (1 − α) v + α |v| a/|a| + dt a in the metric of the masses.
    const double turn = motion_.scaled > 0 ? s_.mixing * std::sqrt(motion_.kinetic / motion_.scaled) : 0;
    const double push = turn + s_.dt;
    const double most = rate / s_.dt;
    s_.stretch_velocity = (1 - s_.mixing) * s_.stretch_velocity + push / s_.stretch_mass * stretch_force_;
    s_.stretch_velocity = std::clamp(s_.stretch_velocity, -most, most);
    const double factor = std::exp(s_.dt * s_.stretch_velocity);
    Vec<D> scale = Vec<D>::Ones();
    for (int a = 0; a < D; ++a) {
      if (Drive::stretches(a))
        scale[a] = factor;
    }
    s_.size = s_.size.cwiseProduct(scale);
    parallel_for(n_, [&](std::size_t i) {
      if (force(i).isZero(0)) {
        velocity(i).setZero(); // a rattler only follows the box
        position(i) = position(i).cwiseProduct(scale);
        return;
      }
      velocity(i) = (1 - s_.mixing) * velocity(i) + push / s_.masses[i] * force(i);
      Vec<D> move = s_.dt * velocity(i);
      const double longest = kLongestMove * radii_[i];
      if (const double length = move.norm(); length > longest)
        move *= longest / length;
      position(i) = position(i).cwiseProduct(scale) + move;
    });
  }

  void write(ByteWriter& out) const {
    for_each(s_, [&](const auto& value) { out.put(value); });
  }
  /// False, and nothing changed, if that is no state of these spheres.
  bool read(ByteReader& in) {
    State read;
    for_each(read, [&](auto& value) { in.get(value); });
    if (!in.good || !in.at_end() || read.positions.size() != n_ * D || read.velocities.size() != n_ * D ||
        read.masses.size() != n_)
      return false;
    s_ = std::move(read);
    return true;
  }

private:
  template <class Self, class F>
  static void for_each(Self& s, F&& f) {
    f(s.size);
    f(s.positions);
    f(s.velocities);
    f(s.masses);
    f(s.stretch_velocity);
    f(s.stretch_mass);
    f(s.dt);
    f(s.mixing);
    f(s.downhill);
    f(s.evaluations);
  }

  /// Sums of one pass over the spheres.
  struct Motion {
    double power = 0;   // F·v
    double force = 0;   // F²
    double scaled = 0;  // F²/m
    double kinetic = 0; // m v²
    double touched = 0; // spheres with a force
    double lever = 0;   // F·x along the axes that stretch
    [[no_unique_address]] typename Drive::Beside beside{};
    void operator+=(const Motion& other) {
      power += other.power;
      force += other.force;
      scaled += other.scaled;
      kinetic += other.kinetic;
      touched += other.touched;
      lever += other.lever;
      beside += other.beside;
    }
  };

  [[nodiscard]] Eigen::Map<Vec<D>> force(std::size_t i) { return Eigen::Map<Vec<D>>(forces_.data() + i * D); }
  [[nodiscard]] Eigen::Map<Vec<D>> velocity(std::size_t i) { return Eigen::Map<Vec<D>>(s_.velocities.data() + i * D); }

  /// A mass that follows its contacts keeps its momentum as it grows, so that a new contact brings no energy in.
  template <class Velocity>
  static void set_mass(double& mass, double wanted, bool may_fall, Velocity&& velocity) {
    if (wanted <= mass && !may_fall)
      return;
    if (Drive::kReweigh && wanted > mass)
      velocity *= mass / wanted;
    mass = wanted;
  }

  std::size_t n_;
  std::vector<std::uint32_t> order_;
  std::vector<double> radii_;
  NeighbourList<D> list_;
  OverlapForces<D, Law> kernel_;
  State s_;
  std::vector<double> forces_;
  std::vector<double> stiffness_;
  ContactSums sums_;
  Motion motion_;
  double stretch_force_ = 0;
  double balance_ = 0;
};

} // namespace tamp
