// Impossible, missing and superfluous values of a stated size distribution.
#include "engine/model/psd.h"
#include "engine/model/truncated_normal.h"

#include <algorithm>
#include <numeric>

namespace tamp {

namespace {

using Problems = std::vector<PsdProblem>;

constexpr unsigned bit(Law law) {
  return 1U << static_cast<unsigned>(law);
}
constexpr unsigned kTruncated = bit(Law::lognormal) | bit(Law::normal) | bit(Law::weibull);
constexpr unsigned kWithMoments = bit(Law::lognormal) | bit(Law::normal);

enum class Range { any, positive };

struct Parameter {
  std::string_view name;
  double Psd::*value;
  unsigned laws; // that read it
  Range range;
};

constexpr std::array kParameters{
    Parameter{"radius", &Psd::radius, bit(Law::monodisperse), Range::positive},
    Parameter{"mu_ln", &Psd::mu_ln, bit(Law::lognormal), Range::any},
    Parameter{"sigma_ln", &Psd::sigma_ln, bit(Law::lognormal), Range::positive},
    Parameter{"mean", &Psd::mean, kWithMoments, Range::positive},
    Parameter{"sd", &Psd::sd, kWithMoments, Range::positive},
    Parameter{"small_radius", &Psd::small_radius, bit(Law::bimodal), Range::positive},
    Parameter{"size_ratio", &Psd::size_ratio, bit(Law::bimodal), Range::positive},
    Parameter{"large_volume_fraction", &Psd::large_volume_fraction, bit(Law::bimodal), Range::any},
    Parameter{"scale", &Psd::scale, bit(Law::weibull), Range::positive},
    Parameter{"shape", &Psd::shape, bit(Law::weibull), Range::positive},
    Parameter{"r_min", &Psd::r_min, kTruncated, Range::positive},
    Parameter{"r_max", &Psd::r_max, kTruncated, Range::positive},
};

std::string no_field_of(Law law) {
  return "is no parameter of the law " + std::string(name_of(law));
}

/// A lognormal law may be stated by either pair, so none of the four is missing by itself.
bool either_or(const Parameter& parameter, Law law) {
  return law == Law::lognormal && parameter.value != &Psd::r_min && parameter.value != &Psd::r_max;
}

void check_parameters(const Psd& psd, Problems& problems) {
  for (const Parameter& parameter : kParameters) {
    const double value = psd.*parameter.value;
    const auto add = [&](std::string problem) {
      problems.push_back({std::string(parameter.name), std::move(problem)});
    };
    if ((parameter.laws & bit(psd.law)) == 0) {
      if (stated(value))
        add(no_field_of(psd.law));
    } else if (!stated(value)) {
      if (!either_or(parameter, psd.law))
        add("is missing: the law " + std::string(name_of(psd.law)) + " needs it");
    } else if (!std::isfinite(value)) {
      add("must be finite");
    } else if (parameter.range == Range::positive && value <= 0) {
      add("must be positive");
    }
  }
  const bool by_parameters = stated(psd.mu_ln) && stated(psd.sigma_ln);
  const bool by_moments = stated(psd.mean) && stated(psd.sd) && !stated(psd.mu_ln) && !stated(psd.sigma_ln);
  if (psd.law == Law::lognormal && !by_parameters && !by_moments) {
    const std::string missing = stated(psd.mu_ln) ? "sigma_ln" : "mu_ln";
    problems.push_back({missing, "is missing: state mu_ln and sigma_ln, or mean and sd"});
  }
}

void check_bimodal(const Psd& psd, Problems& problems) {
  if (psd.size_ratio < 1)
    problems.push_back({"size_ratio", "must be at least 1"});
  if (psd.large_volume_fraction < 0 || psd.large_volume_fraction > 1) {
    problems.push_back({"large_volume_fraction", "must lie in [0, 1]"});
  }
}

void check_histogram(const Psd& psd, Problems& problems) {
  const auto& edges = psd.edges;
  const auto& weights = psd.weights;
  const auto finite = [](double x) { return std::isfinite(x); };
  if (weights.empty())
    problems.push_back({"weights", "is missing: the law histogram needs it"});
  if (edges.size() != weights.size() + 1)
    problems.push_back({"edges", "must be one more than weights"});
  if (!std::all_of(edges.begin(), edges.end(), finite))
    problems.push_back({"edges", "must be finite"});
  if (!std::all_of(weights.begin(), weights.end(), finite))
    problems.push_back({"weights", "must be finite"});
  if (!problems.empty())
    return;
  if (std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<>{}) != edges.end()) {
    problems.push_back({"edges", "must increase"});
  }
  const auto filled = std::find_if(weights.begin(), weights.end(), [](double w) { return w > 0; });
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return w < 0; })) {
    problems.push_back({"weights", "must not be negative"});
  } else if (filled == weights.end()) {
    problems.push_back({"weights", "must not all be zero"});
  } else if (!std::isfinite(std::accumulate(weights.begin(), weights.end(), 0.0))) {
    problems.push_back({"weights", "must have a finite sum"});
  } else if (edges[static_cast<std::size_t>(filled - weights.begin())] <= 0) {
    // A bin from 0 holds spheres of no size, infinitely many of them if it states a volume.
    problems.push_back({"edges", "must be positive from the first bin with a weight on"});
  }
}

/// Share of the law as stated, in its own weighting, that the truncation keeps.
double mass(const Psd& psd) {
  if (psd.law == Law::weibull) {
    const auto coarser = [&psd](double r) { return std::exp(-std::pow(r / psd.scale, psd.shape)); };
    const auto finer = [&psd](double r) { return -std::expm1(-std::pow(r / psd.scale, psd.shape)); };
    return coarser(psd.r_min) < 0.5 ? coarser(psd.r_min) - coarser(psd.r_max) : finer(psd.r_max) - finer(psd.r_min);
  }
  if (psd.law == Law::normal)
    return normal_share((psd.r_min - psd.mean) / psd.sd, (psd.r_max - psd.mean) / psd.sd);
  const auto z = [&psd](double r) { return (std::log(r) - psd.mu_ln) / psd.sigma_ln; };
  return normal_share(z(psd.r_min), z(psd.r_max));
}

void check_truncation(const Psd& psd, Problems& problems) {
  if (psd.r_min >= psd.r_max)
    problems.push_back({"r_min", "must be smaller than r_max"});
  // The mass is a question only once every single value makes sense and the moments agree.
  if (!problems.empty() || contradiction(psd))
    return;
  if (!(mass(completed(psd)) >= kLeastMass)) {
    problems.push_back({"r_min", "leaves nothing of the law between r_min and r_max; is the unit the same?"});
  }
}

} // namespace

std::vector<PsdProblem> check(const Psd& psd) {
  Problems problems;
  check_parameters(psd, problems);
  if (psd.weighting == Weighting::volume && psd.law != Law::weibull && psd.law != Law::histogram) {
    problems.push_back({"weighting", no_field_of(psd.law)});
  }
  if (psd.law == Law::histogram) {
    check_histogram(psd, problems);
  } else {
    if (!psd.edges.empty())
      problems.push_back({"edges", no_field_of(psd.law)});
    if (!psd.weights.empty())
      problems.push_back({"weights", no_field_of(psd.law)});
  }
  if (psd.law == Law::bimodal)
    check_bimodal(psd, problems);
  if ((bit(psd.law) & kTruncated) != 0)
    check_truncation(psd, problems);
  return problems;
}

} // namespace tamp
