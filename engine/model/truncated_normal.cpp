// Tails and quantiles of the truncated normal law.
#include "engine/model/truncated_normal.h"

#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tamp {

namespace {

// Boost works in long double by default: slower by several times for digits that a double cannot keep.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

double upper_tail(double z) {
  return 0.5 * std::erfc(z / std::numbers::sqrt2);
}
double upper_tail_inverse(double q) {
  return std::numbers::sqrt2 * boost::math::erfc_inv(2 * q, InDouble());
}

} // namespace

double normal_share(double z1, double z2) {
  return z1 > 0 ? upper_tail(z1) - upper_tail(z2) : upper_tail(-z2) - upper_tail(-z1);
}

double normal_density(double z) {
  return std::exp(-z * z / 2) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
}

TruncatedNormal::TruncatedNormal(double z_min, double z_max)
    : z_min_(z_min), z_max_(z_max), below_(upper_tail(-z_min)), above_(upper_tail(z_max)),
      mass_(normal_share(z_min, z_max)), u_at_zero_(cdf(std::clamp(0.0, z_min, z_max))) {}

double TruncatedNormal::cdf(double z) const {
  return z > 0 ? 1 - normal_share(z, z_max_) / mass_ : normal_share(z_min_, z) / mass_;
}

double TruncatedNormal::quantile(double u) const {
  if (u < u_at_zero_)
    return -upper_tail_inverse(below_ + u * mass_);
  return upper_tail_inverse(above_ + (1 - u) * mass_);
}

} // namespace tamp
