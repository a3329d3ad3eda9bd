// Student's t test of the difference of two means: of independent samples with different variances, or of pairs.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace tamp {

/// b minus a, in the unit of the samples.
struct MeanDifference {
  double difference = 0;
  double standard_error = 0;
  double freedom = 0; ///< degrees of freedom
  double t = 0;
  double p = 1; ///< two-sided: probability of a difference at least as large where there is none
};

/// Welch, Biometrika 34, 28 (1947), with the degrees of freedom of Satterthwaite. Nothing where a sample has fewer than
/// two numbers or neither has any spread.
std::optional<MeanDifference> welch_test(std::span<const double> a, std::span<const double> b);

/// Of pairs a[i], b[i]; the spans must have one length. Nothing for fewer than two pairs or if all differ alike.
std::optional<MeanDifference> paired_test(std::span<const double> a, std::span<const double> b);

/// Holm, Scand. J. Statist. 6, 65 (1979): probabilities so raised that the chance of even one false finding among all
/// of them stays below the level they are held against.
std::vector<double> holm_adjusted(std::span<const double> p);

} // namespace tamp
