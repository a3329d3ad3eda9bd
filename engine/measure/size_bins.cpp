// Equal bins, and one bin per size of discrete laws.
#include "engine/measure/size_bins.h"

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

/// Radii this close, relative to their size, are the same: a unit of length was changed, or a number printed and read.
constexpr double kSameRadius = 1e-9;

} // namespace

SizeBins::SizeBins(const SizeLaw& law, std::size_t bins)
    : law_(&law), count_(law.classes().empty() ? bins : law.classes().size()) {}

std::optional<std::size_t> SizeBins::of(double radius) const {
  if (discrete()) {
    for (std::size_t c = 0; c < count_; ++c) {
      if (std::abs(radius - law_->classes()[c]) <= kSameRadius * radius)
        return c;
    }
    return std::nullopt;
  }
  const double low = law_->smallest();
  const double high = law_->largest();
  if (radius < low * (1 - kSameRadius) || radius > high * (1 + kSameRadius))
    return std::nullopt;
  const double place = (radius - low) / (high - low) * static_cast<double>(count_);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count_ - 1)));
}

double SizeBins::edge(std::size_t bin) const {
  if (discrete())
    return law_->classes()[bin];
  const double t = static_cast<double>(bin) / static_cast<double>(count_);
  return bin == count_ ? law_->largest() : law_->smallest() + t * (law_->largest() - law_->smallest());
}

std::vector<double> SizeBins::shares(int power) const {
  std::vector<double> shares(count_);
  for (std::size_t b = 0; b < count_; ++b) {
    if (discrete())
      shares[b] = law_->class_shares()[b] * std::pow(law_->classes()[b], power) / law_->moment(power);
    else
      shares[b] = std::max(0.0, law_->weighted_cdf(edge(b + 1), power) - law_->weighted_cdf(edge(b), power));
  }
  return shares;
}

} // namespace tamp
