// The lognormal law that radii seem to follow, with the confidence that their number allows.
#pragma once

#include "engine/model/psd.h"

#include <span>

namespace tamp {

/// Maximum likelihood: mean and standard deviation of ln(radius), number-weighted. With fewer than two different radii
/// sigma_ln is 0. The 95 % half-widths are those of a normal sample, 1.96 s/√n and 1.96 s/√(2n). `distance` is that of
/// Kolmogorov and Smirnov between radii and fit; were the law lognormal, it would exceed `limit` = 0.886/√n in one
/// sample of twenty (Lilliefors, J. Am. Stat. Assoc. 62, 399, 1967, for more than 30 radii).
struct LognormalFit {
  double mu_ln = 0;
  double mu_ln_error = 0;
  double sigma_ln = 0;
  double sigma_ln_error = 0;
  double distance = 0;
  double limit = 0;
};

/// radii: at least one, finite, above 0.
LognormalFit fit_lognormal(std::span<const double> radii);

/// The law of a fit, cut to the range of the radii; equal radii make it monodisperse.
Psd law_of_fit(const LognormalFit& fit, std::span<const double> radii);

} // namespace tamp
