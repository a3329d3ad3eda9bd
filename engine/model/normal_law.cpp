// Moments of the truncated normal law.
#include "engine/model/normal_law.h"

#include <cmath>

namespace tamp {

NormalLaw::NormalLaw(double mean, double sd, double r_min, double r_max)
    : mean_(mean), sd_(sd), r_min_(r_min), r_max_(r_max), normal_(z(r_min), z(r_max)) {}

// With I_j = integral of z^j phi(z), parts give I_j = (j-1) I_{j-2} + [-z^{j-1} phi(z)]; then (mean + sd z)^k is
// expanded.
double NormalLaw::partial_moment(int k, double r) const {
  const double lower = normal_.z_min();
  const double upper = z(r);
  const auto boundary = [&](int power) {
    return std::pow(lower, power) * normal_density(lower) - std::pow(upper, power) * normal_density(upper);
  };
  double before = 0;                           // I_{j-2}
  double last = 0;                             // I_{j-1}
  double current = normal_share(lower, upper); // I_j
  double binomial = 1;
  double sum = std::pow(mean_, k) * current;
  for (int j = 1; j <= k; ++j) {
    before = last;
    last = current;
    current = (j - 1) * before + boundary(j - 1);
    binomial *= static_cast<double>(k - j + 1) / j;
    sum += binomial * std::pow(mean_, k - j) * std::pow(sd_, j) * current;
  }
  return sum / normal_.mass();
}

} // namespace tamp
