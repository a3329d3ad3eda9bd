// Parameters against moments of a stated size distribution.
#include "engine/model/psd.h"

#include "engine/base/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace tamp {

namespace {

struct Parameters {
  double mu_ln;
  double sigma_ln;
};

Parameters lognormal_parameters(double mean, double sd) {
  const double ratio = sd / mean;
  const double variance = std::log1p(ratio * ratio);
  return {std::log(mean) - variance / 2, std::sqrt(variance)};
}

/// Relative distance of a stated moment from the one that the parameters imply; 0 if it is not stated.
double mismatch(double moment, double implied) {
  return stated(moment) ? std::abs(moment - implied) / std::abs(implied) : 0;
}

double mismatch(const Psd& psd) {
  const Moments implied = lognormal_moments(psd.mu_ln, psd.sigma_ln);
  return std::max(mismatch(psd.mean, implied.mean), mismatch(psd.sd, implied.sd));
}

/// The order of the four stated numbers that agrees best, if any agrees.
std::optional<Psd> reordered(const Psd& psd) {
  std::array<double, 4> numbers{psd.mu_ln, psd.sigma_ln, psd.mean, psd.sd};
  if (std::any_of(numbers.begin(), numbers.end(), [](double x) { return !stated(x); }))
    return std::nullopt;
  std::sort(numbers.begin(), numbers.end());
  std::optional<Psd> best;
  do {
    Psd other = psd;
    other.mu_ln = numbers[0];
    other.sigma_ln = numbers[1];
    other.mean = numbers[2];
    other.sd = numbers[3];
    if (!(other.sigma_ln > 0 && other.mean > 0 && other.sd > 0 && mismatch(other) <= kMomentTolerance))
      continue;
    if (!best || mismatch(other) < mismatch(*best))
      best = other;
  } while (std::next_permutation(numbers.begin(), numbers.end()));
  return best;
}

std::string pair(std::string_view first_name, double first, std::string_view second_name, double second) {
  if (!stated(second))
    return fmt::format("{} {:.4g}", first_name, first);
  if (!stated(first))
    return fmt::format("{} {:.4g}", second_name, second);
  return fmt::format("{} {:.4g} and {} {:.4g}", first_name, first, second_name, second);
}

std::string parameters_text(double mu_ln, double sigma_ln) {
  return pair("mu_ln", mu_ln, "sigma_ln", sigma_ln);
}
std::string moments_text(double mean, double sd) {
  return pair("mean", mean, "sd", sd);
}

} // namespace

Moments lognormal_moments(double mu_ln, double sigma_ln) {
  const double variance = sigma_ln * sigma_ln;
  const double mean = std::exp(mu_ln + variance / 2);
  return {mean, mean * std::sqrt(std::expm1(variance))};
}

std::optional<std::string> contradiction(const Psd& psd) {
  if (psd.law != Law::lognormal || !stated(psd.mu_ln) || !stated(psd.sigma_ln))
    return std::nullopt;
  if (mismatch(psd) <= kMomentTolerance)
    return std::nullopt;
  const Moments implied = lognormal_moments(psd.mu_ln, psd.sigma_ln);
  std::string message = fmt::format("parameters contradict moments: {} go with {}, but the statement says {}",
                                    parameters_text(psd.mu_ln, psd.sigma_ln), moments_text(implied.mean, implied.sd),
                                    moments_text(psd.mean, psd.sd));
  if (const auto other = reordered(psd)) {
    message += fmt::format("; the same four numbers agree in another order: {} go with {}",
                           parameters_text(other->mu_ln, other->sigma_ln), moments_text(other->mean, other->sd));
  }
  if (stated(psd.mean) && stated(psd.sd) && psd.mean > 0) {
    const Parameters needed = lognormal_parameters(psd.mean, psd.sd);
    message +=
        fmt::format("; {} go with {}", moments_text(psd.mean, psd.sd), parameters_text(needed.mu_ln, needed.sigma_ln));
  }
  return message;
}

Psd completed(Psd psd) {
  if (psd.law != Law::lognormal)
    return psd;
  if (const auto message = contradiction(psd))
    throw InputError("psd: " + *message);
  if (!stated(psd.mu_ln) && !stated(psd.sigma_ln) && stated(psd.mean) && stated(psd.sd)) {
    const Parameters parameters = lognormal_parameters(psd.mean, psd.sd);
    psd.mu_ln = parameters.mu_ln;
    psd.sigma_ln = parameters.sigma_ln;
  }
  if (stated(psd.mu_ln) && stated(psd.sigma_ln))
    psd.mean = psd.sd = unstated;
  return psd;
}

double large_number_share(const Psd& psd, int dimension) {
  const double large = psd.large_volume_fraction / std::pow(psd.size_ratio, dimension);
  return large / (large + (1 - psd.large_volume_fraction));
}

} // namespace tamp
