// From a stated size distribution to its law.
#include "engine/model/size_law.h"

#include "engine/base/error.h"

#include <algorithm>
#include <utility>

namespace tamp {

namespace {

using Family = std::variant<DiscreteLaw, LognormalLaw, NormalLaw, WeibullLaw, HistogramLaw>;

Family family_of(const Psd& statement, int dimension) {
  if (dimension != 2 && dimension != 3)
    throw InputError("psd: the dimension must be 2 or 3");
  const auto problems = check(statement);
  if (!problems.empty())
    throw InputError("psd: " + problems.front().field + " " + problems.front().problem);
  const Psd psd = completed(statement);
  const int weight = psd.weighting == Weighting::volume ? dimension : 0;
  switch (psd.law) {
  case Law::monodisperse:
    return DiscreteLaw(psd.radius);
  case Law::bimodal:
    return DiscreteLaw(psd.small_radius, psd.small_radius * psd.size_ratio, large_number_share(psd, dimension));
  case Law::lognormal:
    return LognormalLaw(psd.mu_ln, psd.sigma_ln, psd.r_min, psd.r_max);
  case Law::normal:
    return NormalLaw(psd.mean, psd.sd, psd.r_min, psd.r_max);
  case Law::weibull:
    return WeibullLaw(psd.scale, psd.shape, weight, psd.r_min, psd.r_max);
  case Law::histogram:
    return HistogramLaw(psd.edges, psd.weights, weight);
  }
  throw InputError("psd: unknown law");
}

} // namespace

SizeLaw::SizeLaw(const Psd& psd, int dimension) : law_(family_of(psd, dimension)) {}

double SizeLaw::cdf(double r) const {
  if (r < smallest())
    return 0;
  if (r >= largest())
    return 1;
  return std::clamp(std::visit([r](const auto& law) { return law.cdf(r); }, law_), 0.0, 1.0);
}

double SizeLaw::quantile(double u) const {
  return std::visit(
      [u](const auto& law) {
        if (u <= 0)
          return law.smallest();
        if (u >= 1)
          return law.largest();
        return std::clamp(law.quantile(u), law.smallest(), law.largest());
      },
      law_);
}

double SizeLaw::moment(int k) const {
  return std::visit([k](const auto& law) { return law.partial_moment(k, law.largest()); }, law_);
}

double SizeLaw::weighted_cdf(double r, int k) const {
  if (r < smallest())
    return 0;
  if (r >= largest())
    return 1;
  return std::visit(
      [r, k](const auto& law) {
        return std::clamp(law.partial_moment(k, r) / law.partial_moment(k, law.largest()), 0.0, 1.0);
      },
      law_);
}

double SizeLaw::smallest() const {
  return std::visit([](const auto& law) { return law.smallest(); }, law_);
}

double SizeLaw::largest() const {
  return std::visit([](const auto& law) { return law.largest(); }, law_);
}

std::span<const double> SizeLaw::classes() const {
  const auto* discrete = std::get_if<DiscreteLaw>(&law_);
  return discrete != nullptr ? discrete->radii() : std::span<const double>{};
}

std::span<const double> SizeLaw::class_shares() const {
  const auto* discrete = std::get_if<DiscreteLaw>(&law_);
  return discrete != nullptr ? discrete->shares() : std::span<const double>{};
}

} // namespace tamp
