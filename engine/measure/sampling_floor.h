// What the Hellinger distance of a perfect random sampler is: below it there is nothing to be told about a method.
#pragma once

#include "engine/measure/size_bins.h"
#include "engine/model/size_law.h"

#include <cstdint>
#include <span>

namespace tamp {

/// H = sqrt(1 − Σ sqrt(p q)) for Σ p + outside = Σ q = 1, as sqrt(½ Σ (√p − √q)² + ½ outside), which does not cancel.
/// `outside` is the share of p in no bin.
double hellinger_distance(std::span<const double> p, double outside, std::span<const double> q);

/// sqrt(E[H²]) of the number-weighted distance of n independent draws: the counts are binomial, and the expectation is
/// summed term by term. About sqrt((K − 1) / (8 n)) where each of K bins holds many.
double number_floor(std::span<const double> shares, std::uint64_t n);

/// sqrt(E[H²]) of the distance weighted by r^power of n independent draws. Discrete laws: exact, as above. Continuous
/// laws: by simulation with a fixed seed, whose cost grows with the number of bins, not with n (up to 512 repetitions,
/// a standard error of about 1 % for the paper's powder, where a handful of large spheres decides; 4 at K = 10⁶ bins).
double weighted_floor(const SizeLaw& law, const SizeBins& bins, int power, std::uint64_t n);

} // namespace tamp
