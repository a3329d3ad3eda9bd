// Settling at moduli that rise in stages, the height of the whole bed being a variable of its own.
//
// Minimised is E + Σ W z, with the places x of the spheres and a vertical stretch z ∝ e^ε of all of them as variables:
// −∂/∂ε = Σ F_z z. A loose cloud is so drawn together as a whole before its spheres settle, and a bed whose contacts
// are made stiffer rises as a whole. Soft contacts make a bed with a rigid backbone within some hundred evaluations,
// as they feel many neighbours; stiffened step by step it stays one. Settled with stiff contacts from the start it
// would be barely rigid all the way, and creep: that takes ten times the evaluations.
#include "engine/dem/relax.h"

#include "engine/dem/elastic_minimiser.h"

#include <chrono>
#include <optional>

namespace tamp {

namespace {

/// The modulus rises by at most this factor; the last one is chosen to take the deepest overlap to this share of the
/// tolerance, under the same force δ ∝ E*^(−2/3).
constexpr double kStiffening = 2;
constexpr double kAim = 0.9;

/// A stage is over when the rms net force is below this many mean contact forces, or when the mean height has changed
/// by less than this share within a window of so many evaluations, but not before so many evaluations.
constexpr double kBalanced = 2e-2;
constexpr double kStopStrain = 1e-4;
constexpr std::int64_t kWindow = 100;
constexpr std::int64_t kLeastStage = 400;
constexpr double kManyStrains = 1e9; // nothing is known yet
constexpr std::int64_t kMostEvaluations = 200000;
/// After so many evaluations with overlaps within the tolerance a bed whose mean height changes by less than this share
/// in a window rests, too: small spheres in the pores of large ones go on shifting, as they do under pressure.
constexpr std::int64_t kPatience = 20000;
constexpr double kStill = 1e-5;

/// The whole bed is stretched by at most this share in one step.
constexpr double kRate = 3e-3;

/// A sphere has at least the mass of so many contacts that bear its own weight: those of a free sphere are to come.
constexpr double kLeastBorne = 4;

/// Floor, walls, and weight.
template <int D>
struct Weight {
  static constexpr bool kReweigh = true;
  static constexpr bool stretches(int axis) { return axis == vertical<D>; }
  using Beside = ContactSums;

  const SearchBox<D>& box;
  Hertz law;
  std::span<const double> radii;
  std::span<const double> weights;
  std::span<const double> least_mass;
  double least_stretch_mass;

  template <class Place, class Force>
  ContactSums act(std::size_t i, const Place& x, Force&& force, double& stiffness) const {
    ContactSums sums;
    force[vertical<D>] -= weights[i];
    for (int a = 0; a < D; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      for (std::size_t side = 0; side < 2; ++side) {
        if (box.periodic[axis] || !box.wall[axis][side])
          continue;
        const double overlap = radii[i] - (side == 0 ? x[a] : box.size[a] - x[a]);
        if (!(overlap > 0))
          continue;
        const Repulsion contact = HertzRepulsion{law}.at(overlap, radii[i]);
        force[a] += side == 0 ? contact.force : -contact.force;
        stiffness += contact.stiffness;
        sums.force += contact.force;
        sums.contacts += 1;
        sums.deepest = std::max(sums.deepest, overlap / radii[i]);
      }
    }
    return sums;
  }
  [[nodiscard]] double mass(std::size_t i, double stiffness) const { return std::max(stiffness, least_mass[i]); }
  [[nodiscard]] double pull(const ContactSums& /*sums*/, double lever, const Vec<D>& /*size*/) const { return lever; }
  [[nodiscard]] double stretch_mass(const ContactSums& sums) const {
    return std::max(sums.stretch, least_stretch_mass);
  }
};

template <int D>
class Relaxation {
public:
  explicit Relaxation(const SettleTask<D>& task)
      : task_(task), minimiser_(extent(task), task.box.periodic, flat(task.centres), task.radii),
        s_(minimiser_.state()), weights_(minimiser_.sorted(task.masses, 1)), least_mass_(weights_.size()) {
    for (double& weight : weights_)
      weight *= task.gravity;
    stage_.modulus = task.modulus;
  }

  Settled<D> run() {
    resume();
    auto saved = std::chrono::steady_clock::now();
    for (;;) {
      if (minimiser_.may_checkpoint()) {
        const auto clock = std::chrono::steady_clock::now();
        if (!task_.checkpoint.empty() && s_.evaluations > 0 &&
            std::chrono::duration<double>(clock - saved).count() >= task_.checkpoint_every_s) {
          save();
          saved = clock;
        }
        if (task_.progress)
          task_.progress(std::min(1.0, task_.overlap / std::max(sums().deepest, task_.overlap)));
      }
      minimiser_.find_neighbours();
      minimiser_.evaluate(HertzRepulsion{{stage_.modulus}}, weight());
      if (const auto rests = judge())
        return finish(*rests);
      if (stage_.began < s_.evaluations) // else the forces are those of the stage before
        minimiser_.step(kRate);
    }
  }

private:
  /// Where the run is on its way, beside the minimiser's own state.
  struct Stage {
    double modulus = 0;
    std::int64_t began = 0; // at this many evaluations
    std::int64_t stiffenings = 0;
    std::int64_t patience = 0;    // evaluations since the overlaps came within the tolerance
    double window_began = 0;      // logarithm of the mean height when the window did
    double strain = kManyStrains; // change of that logarithm in the last whole window

    template <class F>
    void for_each(F&& f) {
      f(modulus);
      f(began);
      f(stiffenings);
      f(patience);
      f(window_began);
      f(strain);
    }
  };

  /// The box, as high as the cloud.
  static Vec<D> extent(const SettleTask<D>& task) {
    Vec<D> size = task.box.size;
    double& top = size[vertical<D>];
    top = 0;
    for (std::size_t i = 0; i < task.radii.size(); ++i)
      top = std::max(top, task.centres[i][vertical<D>] + task.radii[i]);
    return size;
  }
  static std::vector<double> flat(const std::vector<Vec<D>>& centres) {
    std::vector<double> numbers;
    for (const Vec<D>& c : centres)
      numbers.insert(numbers.end(), c.data(), c.data() + D);
    return numbers;
  }

  /// The drive at the present modulus.
  Weight<D> weight() {
    if (least_mass_of_ != stage_.modulus) {
      // Two equal spheres that bear W between them.
      least_mass_of_ = stage_.modulus;
      least_stretch_mass_ = 0;
      for (std::size_t i = 0; i < minimiser_.count(); ++i) {
        const double r = minimiser_.radii()[i];
        least_mass_[i] = kLeastBorne * hertz_stiffness(stage_.modulus, effective(r, r), weights_[i]);
        least_stretch_mass_ += least_mass_[i] * r * r;
      }
    }
    return {task_.box, {stage_.modulus}, minimiser_.radii(), weights_, least_mass_, least_stretch_mass_};
  }

  [[nodiscard]] double mean_height() {
    struct Moment {
      double weight = 0;
      double lever = 0;
      void operator+=(const Moment& other) {
        weight += other.weight;
        lever += other.lever;
      }
    };
    const auto sum = parallel_sum<Moment>(minimiser_.count(), [&](std::size_t i) {
      return Moment{weights_[i], weights_[i] * minimiser_.position(i)[vertical<D>]};
    });
    return sum.lever / sum.weight;
  }

  /// Whether the bed rests, if that is known; else goes to the next stage when the present one is over.
  std::optional<bool> judge() {
    if (s_.evaluations % kWindow == 0) {
      const double now = std::log(mean_height());
      stage_.strain = s_.evaluations - stage_.began >= kWindow ? std::abs(now - stage_.window_began) : kManyStrains;
      stage_.window_began = now;
    }
    const bool shallow = sums().deepest <= task_.overlap || stage_.modulus >= task_.largest_modulus;
    stage_.patience = shallow ? stage_.patience + 1 : 0;
    if (shallow &&
        (minimiser_.balance() <= task_.force_balance || (stage_.patience > kPatience && stage_.strain < kStill)))
      return true;
    const bool over = minimiser_.balance() < kBalanced ||
                      (stage_.strain < kStopStrain && s_.evaluations - stage_.began >= kLeastStage);
    if (!shallow && over) {
      stage_.modulus =
          std::min(task_.largest_modulus,
                   stage_.modulus * std::min(kStiffening, std::pow(sums().deepest / (kAim * task_.overlap), 1.5)));
      stage_.began = s_.evaluations;
      stage_.strain = kManyStrains;
      ++stage_.stiffenings;
      minimiser_.rest();
    }
    if (s_.evaluations >= kMostEvaluations)
      return false;
    return std::nullopt;
  }

  Settled<D> finish(bool rests) {
    Settled<D> bed;
    const std::vector<double> positions = minimiser_.positions();
    for (std::size_t i = 0; i < minimiser_.count(); ++i)
      bed.centres.emplace_back(Eigen::Map<const Vec<D>>(positions.data() + i * D));
    bed.at_rest = rests;
    bed.modulus = stage_.modulus;
    bed.overlap = sums().deepest;
    bed.force_balance = minimiser_.balance();
    bed.steps = s_.evaluations;
    bed.stiffenings = stage_.stiffenings;
    bed.list_rebuilds = static_cast<std::int64_t>(minimiser_.list().rebuilds());
    return bed;
  }

  void save() {
    ByteWriter out;
    stage_.for_each([&](const auto& value) { out.put(value); });
    minimiser_.write(out);
    write_atomically(task_.checkpoint, out.bytes());
  }

  void resume() {
    std::error_code none;
    if (task_.checkpoint.empty() || !std::filesystem::exists(task_.checkpoint, none))
      return;
    const std::string bytes = read_file(task_.checkpoint);
    ByteReader in(bytes);
    Stage read;
    read.for_each([&](auto& value) { in.get(value); });
    if (minimiser_.read(in))
      stage_ = read;
  }

  [[nodiscard]] const ContactSums& sums() const { return minimiser_.sums(); }

  const SettleTask<D>& task_;
  ElasticMinimiser<D, HertzRepulsion, Weight<D>> minimiser_;
  typename ElasticMinimiser<D, HertzRepulsion, Weight<D>>::State& s_;
  Stage stage_;
  std::vector<double> weights_;
  std::vector<double> least_mass_;
  double least_mass_of_ = 0; // modulus of the least masses
  double least_stretch_mass_ = 0;
};

} // namespace

template <int D>
Settled<D> relax(const SettleTask<D>& task) {
  return Relaxation<D>(task).run();
}

template Settled<2> relax(const SettleTask<2>&);
template Settled<3> relax(const SettleTask<3>&);

} // namespace tamp
