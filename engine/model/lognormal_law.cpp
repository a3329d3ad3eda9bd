// Closed forms of the truncated lognormal law.
#include "engine/model/lognormal_law.h"

#include <cmath>

namespace tamp {

LognormalLaw::LognormalLaw(double mu_ln, double sigma_ln, double r_min, double r_max)
    : mu_(mu_ln), sigma_(sigma_ln), r_min_(r_min), r_max_(r_max), normal_(z(r_min), z(r_max)) {}

double LognormalLaw::z(double r) const {
  return (std::log(r) - mu_) / sigma_;
}

double LognormalLaw::quantile(double u) const {
  return std::exp(mu_ + sigma_ * normal_.quantile(u));
}

double LognormalLaw::partial_moment(int k, double r) const {
  const double shift = k * sigma_;
  const double whole = std::exp(k * mu_ + shift * shift / 2);
  return whole * normal_share(normal_.z_min() - shift, z(r) - shift) / normal_.mass();
}

} // namespace tamp
