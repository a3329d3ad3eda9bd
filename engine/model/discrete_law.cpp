// Classes and moments of mono- and bidisperse spheres.
#include "engine/model/discrete_law.h"

#include <cmath>
#include <cstddef>

namespace tamp {

DiscreteLaw::DiscreteLaw(double small, double large, double large_share) {
  if (large_share < 1) {
    radii_.push_back(small);
    shares_.push_back(1 - large_share);
  }
  if (large_share > 0 && large > small) {
    radii_.push_back(large);
    shares_.push_back(large_share);
  }
  if (radii_.empty())
    radii_.push_back(large);
  if (radii_.size() == 1)
    shares_.assign(1, 1.0);
}

double DiscreteLaw::partial_moment(int k, double r) const {
  double sum = 0;
  for (std::size_t i = 0; i < radii_.size() && radii_[i] <= r; ++i)
    sum += shares_[i] * std::pow(radii_[i], k);
  return sum;
}

} // namespace tamp
