// The parameters by which accuracy is bought with time, and which way is finer.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace tamp {

/// What towards a knob is turned for more accuracy.
enum class Finer { smaller, larger };

struct AccuracyKnob {
  std::string_view path; ///< of the parameter in a campaign file
  Finer finer;
  std::string_view what; ///< the knob in the words of a figure

  /// A step size that falls to 0 as the knob is turned finer.
  [[nodiscard]] constexpr double step(double value) const { return finer == Finer::smaller ? value : 1 / value; }
};

/// Every declared knob. Parameters of the physics (friction, restitution) and of the powder are none: another value
/// there is another question, not a better answer.
inline constexpr std::array kAccuracyKnobs = {
    AccuracyKnob{"scene/count", Finer::larger, "number of particles"},
    AccuracyKnob{"method/max_failures", Finer::larger, "failures that end the packing"},
    AccuracyKnob{"method/sweeps", Finer::larger, "sweeps of moving and enlarging"},
    AccuracyKnob{"method/cloud_phi", Finer::smaller, "density of the loose cloud"},
    AccuracyKnob{"method/start_phi", Finer::smaller, "density of the random start"},
    AccuracyKnob{"method/overlap", Finer::smaller, "overlap allowed"},
    AccuracyKnob{"method/force_balance", Finer::smaller, "net force left"},
    AccuracyKnob{"method/kinetic_energy", Finer::smaller, "kinetic energy left"},
    AccuracyKnob{"method/steps_per_collision", Finer::larger, "time steps in a collision"},
    AccuracyKnob{"method/height_drift", Finer::smaller, "drift of the height left"},
    AccuracyKnob{"method/contact_drift", Finer::smaller, "drift of the contacts left"},
    AccuracyKnob{"method/overlap_tolerance", Finer::smaller, "overlap allowed"},
    AccuracyKnob{"method/force_tolerance", Finer::smaller, "net force left"},
    AccuracyKnob{"method/pressure", Finer::smaller, "pressure of the compression"},
    AccuracyKnob{"method/rate", Finer::smaller, "strain in one step"},
    AccuracyKnob{"method/stop_strain", Finer::smaller, "strain rate left"},
};

constexpr const AccuracyKnob* find_accuracy_knob(std::string_view path) {
  const auto* found = std::find_if(kAccuracyKnobs.begin(), kAccuracyKnobs.end(),
                                   [path](const AccuracyKnob& knob) { return knob.path == path; });
  return found == kAccuracyKnobs.end() ? nullptr : found;
}

} // namespace tamp
