// The table from the effects that a compression calls for to its kernel; and the kernel for none: compression at
// pressures that fall in stages.
//
// Minimised is the enthalpy H = E + p V, with positions x = L u and ε = ln L as variables: −∂H/∂u L⁻¹ = F and
// −∂H/∂ε = Σ f d − D p V. Compression at a high pressure jams the spheres with a rigid backbone; lowering it then
// takes the overlaps down to the tolerance while they stay jammed (as opposed to a quench that stops as soon as
// nothing overlaps). A stage ends when forces balance, or when the box has all but come to rest: small spheres in the
// pores between large ones creep for as long as one cares to look, and the box feels next to nothing of it.
//
// A prescribed packing fraction is come to from above: a quench in a box of that size would take overlaps away at a
// rate that falls with them. Once the pressure is so low that widening the box to the prescribed size parts most
// contacts, it is widened, ε is fixed and E alone minimised, which only has to part the deep ones.
#include "engine/dem/compress.h"

#include "engine/base/error.h"
#include "engine/dem/elastic_minimiser.h"
#include "engine/dem/press_run.h"

#include <chrono>
#include <optional>

namespace tamp {

namespace {

/// Contacts whose stiffness a sphere or the box has at least: those of a free sphere are to come.
constexpr double kLeastContacts = 2;

/// Pressures fall by this factor; the last one is chosen to take the deepest overlap to this share of the tolerance.
/// Falls much deeper open most contacts, which then come back one by one.
constexpr double kPressureDrop = 3;
constexpr double kAim = 0.8;

/// A stage is over when forces balance as the task asks, and the pressure is within this share.
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

template <int D>
double volume_of(const std::vector<double>& radii) {
  constexpr double unit = D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3;
  double sum = 0;
  for (const double r : radii)
    sum += unit * std::pow(r, D);
  return sum;
}

/// Pressure on a periodic box.
template <int D>
struct Pressure {
  static constexpr bool kReweigh = false;
  static constexpr bool stretches(int /*axis*/) { return true; }
  struct Beside {
    void operator+=(const Beside& /*other*/) {}
  };

  std::span<const double> radii;
  double solid; ///< volume of the spheres
  double pressure;
  bool fixed; ///< the box keeps its size

  template <class Place, class Force>
  Beside act(std::size_t /*i*/, const Place& /*x*/, const Force& /*force*/, double& /*stiffness*/) const {
    return {};
  }
  [[nodiscard]] double mass(std::size_t i, double stiffness) const {
    return std::max(stiffness, kLeastContacts * Harmonic<D>::stiffness(radii[i]));
  }
  [[nodiscard]] double pull(const ContactSums& sums, double /*lever*/, const Vec<D>& size) const {
    return fixed ? 0 : sums.virial - D * pressure * size.prod();
  }
  /// A free sphere's share of Σ k d²: two contacts of its own kind; k d² is of the order of its volume.
  [[nodiscard]] double stretch_mass(const ContactSums& sums) const {
    return std::max(sums.stretch, kLeastContacts * solid / std::numbers::pi);
  }
};

template <int D>
class Compression {
public:
  explicit Compression(const CompressTask<D>& task)
      : task_(task), solid_(volume_of<D>(task.radii)),
        minimiser_(task.size, all_periodic(), task.positions, task.radii), s_(minimiser_.state()) {
    stage_.pressure = task.pressure;
  }

  Compressed<D> run() {
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
          task_.progress();
      }
      minimiser_.find_neighbours();
      minimiser_.evaluate({}, Pressure<D>{minimiser_.radii(), solid_, stage_.pressure, stage_.fixed != 0});
      if (const auto end = judge())
        return finish(*end);
      if (stage_.began < s_.evaluations) // else the forces are those of the stage before
        minimiser_.step(task_.rate);
    }
  }

private:
  /// Where the run is on its way, beside the minimiser's own state.
  struct Stage {
    double pressure = 0;
    std::int64_t began = 0;       // at this many evaluations
    std::int64_t patience = 0;    // evaluations since the overlaps came within the tolerance
    std::int64_t fixed = 0;       // 1: the box has the prescribed size
    double window_began = 0;      // logarithm of the volume when the window did
    double strain = kManyStrains; // change of that logarithm in the last whole window

    template <class F>
    void for_each(F&& f) {
      f(pressure);
      f(began);
      f(patience);
      f(fixed);
      f(window_began);
      f(strain);
    }
  };

  static std::array<bool, D> all_periodic() {
    std::array<bool, D> periodic;
    periodic.fill(true);
    return periodic;
  }

  /// Widens the box to the prescribed packing fraction.
  void fix_box() {
    const double factor = std::pow(present_phi() / task_.target_phi, 1.0 / D);
    s_.size *= factor;
    for (double& x : s_.positions)
      x *= factor;
    stage_.fixed = 1;
  }

  /// Goes on at another pressure, from rest.
  void begin_stage(double pressure) {
    stage_.pressure = pressure;
    stage_.began = s_.evaluations;
    stage_.strain = kManyStrains;
    minimiser_.rest();
  }

  [[nodiscard]] double present_pressure() const { return sums().virial / (D * s_.size.prod()); }
  [[nodiscard]] double present_phi() const { return solid_ / s_.size.prod(); }

  /// How the run ends, if it does; else goes to the next stage when the present one is over.
  std::optional<CompressEnd> judge() {
    if (s_.evaluations % kWindow == 0) {
      const double now = std::log(s_.size.prod());
      stage_.strain = s_.evaluations - stage_.began >= kWindow ? std::abs(now - stage_.window_began) : kManyStrains;
      stage_.window_began = now;
    }
    const bool shallow = sums().deepest <= task_.overlap;
    const bool prescribed = !std::isnan(task_.target_phi);
    if (stage_.fixed != 0) {
      if (shallow)
        return CompressEnd::done;
      if (minimiser_.balance() < kJammed)
        return CompressEnd::jammed;
    } else if (std::abs(present_pressure() / stage_.pressure - 1) < kPressureReached) {
      const bool balanced = minimiser_.balance() < task_.force_balance;
      const bool at_rest = stage_.strain < task_.stop_strain && s_.evaluations - stage_.began >= kLeastStage;
      stage_.patience = shallow ? stage_.patience + 1 : 0;
      if (prescribed && (balanced || at_rest)) {
        if (present_phi() < task_.target_phi)
          return CompressEnd::jammed;
        const double opened = 2 * (std::pow(present_phi() / task_.target_phi, 1.0 / D) - 1);
        const bool enough = opened > kOpened * stage_.pressure;
        begin_stage(stage_.pressure / kPressureDrop);
        if (enough)
          fix_box();
      } else if (shallow && (balanced || stage_.patience > kPatience)) {
        return CompressEnd::done;
      } else if (!shallow && (balanced || at_rest)) {
        begin_stage(std::max(stage_.pressure / kPressureDrop, stage_.pressure * kAim * task_.overlap / sums().deepest));
      }
    }
    if (s_.evaluations >= kMostEvaluations)
      return CompressEnd::gave_up;
    return std::nullopt;
  }

  Compressed<D> finish(CompressEnd end) {
    Compressed<D> result;
    result.end = end;
    result.size = s_.size;
    result.positions = minimiser_.positions();
    result.phi = present_phi();
    result.overlap = sums().deepest;
    result.pressure = present_pressure();
    result.force_balance = minimiser_.balance();
    result.evaluations = s_.evaluations;
    result.list_rebuilds = static_cast<std::int64_t>(minimiser_.list().rebuilds());
    result.list_repairs = static_cast<std::int64_t>(minimiser_.list().repairs());
    return result;
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

  const CompressTask<D>& task_;
  double solid_; // volume of the spheres
  ElasticMinimiser<D, Harmonic<D>, Pressure<D>> minimiser_;
  typename ElasticMinimiser<D, Harmonic<D>, Pressure<D>>::State& s_;
  Stage stage_;
};

template <int D>
Compressed<D> minimise(const CompressTask<D>& task) {
  return Compression<D>(task).run();
}

template <int D, class Normal, class Friction>
Compressed<D> press(const CompressTask<D>& task) {
  const ContactNumbers numbers{task.poisson, task.friction, 1, task.adhesion};
  const auto make_law = [&](double modulus) { return contact_law<Normal, NoDamping, Friction>(numbers, modulus); };
  return PressRun<D, ContactLaw<Normal, NoDamping, Friction>>(task, make_law).run();
}

template <int D>
struct Row {
  ContactEffects effects;
  bool minimise;
  Compressed<D> (*kernel)(const CompressTask<D>&);
};

template <int D>
constexpr Row<D> kKernels[] = {
    {{AdhesionLaw::none, false}, true, &minimise<D>},
    {{AdhesionLaw::none, false}, false, &press<D, Hertz, NoFriction>},
    {{AdhesionLaw::none, true}, false, &press<D, Hertz, Mindlin>},
    {{AdhesionLaw::dmt, false}, false, &press<D, Dmt, NoFriction>},
    {{AdhesionLaw::dmt, true}, false, &press<D, Dmt, Mindlin>},
    {{AdhesionLaw::jkr, false}, false, &press<D, Jkr, NoFriction>},
    {{AdhesionLaw::jkr, true}, false, &press<D, Jkr, Mindlin>},
};

} // namespace

template <int D>
Compressed<D> compress(const CompressTask<D>& task) {
  const bool enthalpy_alone = task.effects == ContactEffects{} && !task.in_time;
  for (const Row<D>& row : kKernels<D>) {
    if (row.effects == task.effects && row.minimise == enthalpy_alone)
      return row.kernel(task);
  }
  throw InputError("no kernel has these effects");
}

template Compressed<2> compress(const CompressTask<2>&);
template Compressed<3> compress(const CompressTask<3>&);

} // namespace tamp
