// A fitted lognormal law is the one that was drawn from, within the confidence it states.
#include "engine/base/random.h"
#include "engine/model/lognormal_fit.h"
#include "engine/model/size_law.h"

#include <catch2/catch.hpp>

using namespace tamp;

namespace {

std::vector<double> draws(const Psd& psd, std::size_t n, std::uint64_t replicate) {
  const SizeLaw law(psd, 3);
  RandomStream random("lognormal fit", replicate);
  std::vector<double> radii(n);
  for (double& r : radii)
    r = law.quantile(random.uniform());
  return radii;
}

Psd wide(double mu) {
  Psd psd;
  psd.mu_ln = mu;
  psd.sigma_ln = 0.5;
  psd.r_min = std::exp(mu - 5);
  psd.r_max = std::exp(mu + 5);
  return psd;
}

} // namespace

TEST_CASE("the intervals of a lognormal fit hold the truth in about 95 of 100 samples") {
  int mu_held = 0;
  int sigma_held = 0;
  int near = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const LognormalFit fit = fit_lognormal(draws(wide(0.3), 300, i));
    mu_held += std::abs(fit.mu_ln - 0.3) <= fit.mu_ln_error;
    sigma_held += std::abs(fit.sigma_ln - 0.5) <= fit.sigma_ln_error;
    near += fit.distance <= fit.limit;
  }
  // 380 are expected, with a standard deviation of 4.4.
  for (const int held : {mu_held, sigma_held, near}) {
    CHECK(held > 360);
    CHECK(held < 396);
  }
}

TEST_CASE("a law that is not lognormal is told from one") {
  Psd normal;
  normal.law = Law::normal;
  normal.mean = 3;
  normal.sd = 1.2;
  normal.r_min = 0.1;
  normal.r_max = 9;
  const LognormalFit fit = fit_lognormal(draws(normal, 2000, 0));
  CHECK(fit.distance > 2 * fit.limit);
}

TEST_CASE("a lognormal fit changes with the unit as its logarithm") {
  std::vector<double> radii = draws(wide(0.3), 500, 7);
  const LognormalFit fit = fit_lognormal(radii);
  for (double& r : radii)
    r *= 1000;
  const LognormalFit scaled = fit_lognormal(radii);
  CHECK(scaled.mu_ln == Approx(fit.mu_ln + std::log(1000.0)));
  CHECK(scaled.sigma_ln == Approx(fit.sigma_ln));
  CHECK(scaled.distance == Approx(fit.distance));
}

TEST_CASE("equal radii are a monodisperse law") {
  for (const std::vector<double>& radii : {std::vector<double>{2.5}, std::vector<double>(7, 2.5)}) {
    const LognormalFit fit = fit_lognormal(radii);
    CHECK(fit.sigma_ln == 0);
    const Psd law = law_of_fit(fit, radii);
    CHECK(law.law == Law::monodisperse);
    CHECK(law.radius == 2.5);
  }
  CHECK(check(law_of_fit(fit_lognormal(draws(wide(0), 50, 1)), draws(wide(0), 50, 1))).empty());
}
