// Blocks of radii: strata, class counts, shuffling.
#include "engine/generate/radius_sampler.h"

#include "engine/base/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tamp {

RadiusSampler::RadiusSampler(const SizeLaw& law, Sampler kind, std::uint64_t block, RandomStream stream)
    : law_(law), block_(block), stream_(stream), independent_(kind == Sampler::random && law.classes().empty()) {
  if (block == 0)
    throw InputError("the block of a radius sampler must be at least 1");
}

double RadiusSampler::next() {
  if (independent_) {
    ++drawn_;
    return law_.quantile(stream_.uniform());
  }
  const std::uint64_t place = drawn_ % block_;
  if (place == 0) {
    radii_.resize(block_);
    if (law_.classes().empty()) {
      fill_strata();
    } else {
      fill_classes();
    }
    shuffle();
  }
  ++drawn_;
  return radii_[place];
}

void RadiusSampler::fill_strata() {
  for (std::uint64_t i = 0; i < block_; ++i) {
    radii_[i] = law_.quantile((static_cast<double>(i) + stream_.uniform()) / static_cast<double>(block_));
  }
}

// Rounding the running total instead of the block carries the remainder from block to block.
void RadiusSampler::fill_classes() {
  const double small_share = law_.class_shares().front();
  const auto small_among = [small_share](std::uint64_t n) {
    return static_cast<std::uint64_t>(std::llround(small_share * static_cast<double>(n)));
  };
  const std::uint64_t small = std::min(small_among(drawn_ + block_) - small_among(drawn_), block_);
  const auto boundary = radii_.begin() + static_cast<std::ptrdiff_t>(small);
  std::fill(radii_.begin(), boundary, law_.classes().front());
  std::fill(boundary, radii_.end(), law_.classes().back());
}

// Fisher-Yates.
void RadiusSampler::shuffle() {
  for (std::uint64_t i = block_ - 1; i > 0; --i)
    std::swap(radii_[i], radii_[stream_.below(i + 1)]);
}

std::vector<double> draw_radii(const SizeLaw& law, Sampler kind, std::size_t n, RandomStream stream) {
  std::vector<double> radii(n);
  if (n == 0)
    return radii;
  RadiusSampler sampler(law, kind, n, stream);
  std::generate(radii.begin(), radii.end(), [&sampler] { return sampler.next(); });
  return radii;
}

} // namespace tamp
