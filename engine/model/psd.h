// What a user states about a particle size distribution, and whether the statement makes sense.
#pragma once

#include "engine/model/enum_names.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tamp {

enum class Law { monodisperse, lognormal, bimodal, normal, weibull, histogram };
template <>
struct EnumNames<Law> {
  static constexpr std::array<std::string_view, 6> value{"monodisperse", "lognormal", "bimodal",
                                                         "normal",       "weibull",   "histogram"};
};

/// Whether a law counts spheres, or their volume (area in 2D): `volume` weights a sphere by r^d, d the scene's
/// dimension.
enum class Weighting { number, volume };
template <>
struct EnumNames<Weighting> {
  static constexpr std::array<std::string_view, 2> value{"number", "volume"};
};

/// How radii are drawn from the law (see engine/generate/radius_sampler.h).
enum class Sampler { random, stratified };
template <>
struct EnumNames<Sampler> {
  static constexpr std::array<std::string_view, 2> value{"random", "stratified"};
};

/// The value of a parameter that is not stated.
inline constexpr double unstated = std::numeric_limits<double>::quiet_NaN();
[[nodiscard]] inline bool stated(double value) {
  return !std::isnan(value);
}

/// A size distribution of radii, all lengths in the scene's unit. Each law reads its own group of fields.
struct Psd {
  Law law = Law::lognormal;

  double radius = unstated; // monodisperse

  double mu_ln = unstated; // lognormal: mean and standard deviation of ln(radius), number-weighted, untruncated
  double sigma_ln = unstated;
  double mean = unstated; // lognormal, normal: moments of the number-weighted law before truncation
  double sd = unstated;

  double small_radius = unstated;          // bimodal: R_S
  double size_ratio = unstated;            // bimodal: rho = R_L / R_S
  double large_volume_fraction = unstated; // bimodal: X_L, share of r^d held by the large spheres

  double scale = unstated; // weibull: share of spheres (of volume: Rosin-Rammler) coarser than r: exp(-(r/scale)^shape)
  double shape = unstated;
  Weighting weighting = Weighting::number; // weibull, histogram

  double r_min = unstated; // lognormal, normal, weibull: radii outside [r_min, r_max] do not occur
  double r_max = unstated;

  std::vector<double> edges;   // histogram: K + 1 bin edges, radii uniform (in the law's weighting) inside a bin
  std::vector<double> weights; // histogram: K shares, of any sum
};

/// Relative disagreement between parameters and moments that rounding in print excuses.
inline constexpr double kMomentTolerance = 0.01;

/// Share of the stated law below which its truncation is taken for a slip (most often of unit).
inline constexpr double kLeastMass = 1e-9;

/// Mean and standard deviation of a lognormal law: exp(mu + s^2/2), mean sqrt(exp(s^2) - 1).
struct Moments {
  double mean;
  double sd;
};
[[nodiscard]] Moments lognormal_moments(double mu_ln, double sigma_ln);

/// The message if a lognormal law's parameters contradict its stated moments by more than kMomentTolerance. It says
/// which values would agree, first of all the same four numbers in another order if one order does.
[[nodiscard]] std::optional<std::string> contradiction(const Psd& psd);

/// The canonical form: a lognormal law keeps mu_ln and sigma_ln alone, computed from the moments where only those are
/// stated. Throws InputError on a contradiction.
[[nodiscard]] Psd completed(Psd psd);

/// One impossible, missing or superfluous value.
struct PsdProblem {
  std::string field;
  std::string problem;
};

/// Everything that is wrong with the values, in the order of the fields; empty if a SizeLaw can be built from
/// them. Contradictory moments are a matter for contradiction().
[[nodiscard]] std::vector<PsdProblem> check(const Psd& psd);

/// Number share P_NL of the large spheres of a bimodal law: (X_L/rho^d) / (X_L/rho^d + 1 - X_L).
[[nodiscard]] double large_number_share(const Psd& psd, int dimension);

} // namespace tamp
