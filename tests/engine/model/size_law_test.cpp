// One contract over all size laws, held against direct integration of their densities.
#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/model/size_law.h"
#include "tests/engine/model/psd_examples.h"

#include <boost/math/quadrature/gauss.hpp>
#include <catch2/catch.hpp>

#include <algorithm>

using namespace tamp;
using namespace tamp::test;

namespace {

/// Integral of r^k times the raw density over [a, b], by many small panels in ln r between the histogram's edges.
double integrated(const Psd& psd, int dimension, int k, double a, double b) {
  constexpr double kPanel = 0.002;
  std::vector<double> stops{a, b};
  for (const double edge : psd.edges) {
    if (edge > a && edge < b)
      stops.push_back(edge);
  }
  std::sort(stops.begin(), stops.end());
  const auto f = [&](double x) {
    const double r = std::exp(x);
    return std::pow(r, k + 1) * raw_density(psd, dimension, r);
  };
  double sum = 0;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double x1 = std::log(stops[i]);
    const double x2 = std::log(stops[i + 1]);
    const int panels = static_cast<int>((x2 - x1) / kPanel) + 1;
    for (int p = 0; p < panels; ++p) {
      const double width = (x2 - x1) / panels;
      sum += boost::math::quadrature::gauss<double, 7>::integrate(f, x1 + p * width, x1 + (p + 1) * width);
    }
  }
  return sum;
}

constexpr double kRelative = 1e-12;

/// The distance between radii that the rounding of u near cdf(r) makes; infinite where the law is flat.
double rounding_of(const SizeLaw& law, double r) {
  const double step = 1e-6 * r;
  const double slope = (law.cdf(r + step) - law.cdf(r - step)) / (2 * step);
  return 4 * std::numeric_limits<double>::epsilon() / slope;
}

constexpr int kInside = 40;

} // namespace

TEST_CASE("moments and weighted shares equal the integrals of the density") {
  for (const auto& [name, psd] : continuous_examples()) {
    for (const int dimension : {2, 3}) {
      CAPTURE(name, dimension);
      const SizeLaw law(psd, dimension);
      const double a = law.smallest();
      const double b = law.largest();
      const double number = integrated(psd, dimension, 0, a, b);
      for (const int k : {0, 1, 2, 3, 6}) {
        CAPTURE(k);
        const double whole = integrated(psd, dimension, k, a, b);
        CHECK(law.moment(k) == Approx(whole / number).epsilon(1e-11));
        for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9}) {
          const double r = a * std::pow(b / a, part);
          const double share = integrated(psd, dimension, k, a, r) / whole;
          CHECK(law.weighted_cdf(r, k) == Approx(share).epsilon(1e-10).margin(1e-13));
          if (k == 0)
            CHECK(law.cdf(r) == Approx(share).epsilon(1e-10).margin(1e-13));
        }
      }
    }
  }
}

TEST_CASE("the quantile inverts the distribution function") {
  for (const auto& [name, psd] : continuous_examples()) {
    for (const int dimension : {2, 3}) {
      CAPTURE(name, dimension);
      const SizeLaw law(psd, dimension);
      for (int i = 1; i < kInside; ++i) {
        const double u = i / double{kInside};
        const double r = law.quantile(u);
        CHECK(law.cdf(r) == Approx(u).epsilon(kRelative));
        CHECK(law.quantile(law.cdf(r)) == Approx(r).epsilon(kRelative));
        // Far out in the tails a double u no longer points at one radius: allow for its rounding, and skip flat places.
        const double far = law.smallest() * std::pow(law.largest() / law.smallest(), u);
        const double flat = rounding_of(law, far);
        if (flat < 1e-3 * far)
          CHECK(std::abs(law.quantile(law.cdf(far)) - far) <= kRelative * far + flat);
      }
    }
  }
}

TEST_CASE("quantiles increase from the smallest to the largest radius") {
  for (const auto& [name, psd] : continuous_examples()) {
    CAPTURE(name);
    const SizeLaw law(psd, 3);
    CHECK(law.quantile(0) == law.smallest());
    CHECK(law.quantile(1) == law.largest());
    CHECK(law.cdf(law.smallest()) == Approx(0).margin(1e-15));
    CHECK(law.cdf(law.smallest() * 0.999) == 0);
    CHECK(law.cdf(law.largest()) == 1);
    double before = law.smallest();
    for (int i = 1; i < 4096; ++i) {
      const double r = law.quantile(i / 4096.0);
      CHECK(r > before);
      before = r;
    }
    CHECK(before < law.largest());
    for (const double u : {1e-300, 1e-17, 0x1.0p-53})
      CHECK(law.quantile(u) >= law.smallest());
    CHECK(law.quantile(1 - 0x1.0p-53) <= law.largest());
  }
}

TEST_CASE("nothing depends on the unit of length") {
  constexpr double kMetre = 1e-6;
  for (const auto& [name, psd] : continuous_examples()) {
    CAPTURE(name);
    const SizeLaw micrometres(psd, 3);
    const SizeLaw metres(rescaled(psd, kMetre), 3);
    for (int i = 0; i <= 64; ++i) {
      const double u = i / 64.0;
      CHECK(metres.quantile(u) == Approx(micrometres.quantile(u) * kMetre).epsilon(1e-12));
    }
    for (const int k : {1, 3, 6}) {
      CHECK(metres.moment(k) == Approx(micrometres.moment(k) * std::pow(kMetre, k)).epsilon(1e-11));
    }
  }
}

TEST_CASE("a hardly truncated law keeps the closed moments") {
  const SizeLaw lognormal(lognormal_psd(0.3, 0.68, 1e-4, 1e4), 3);
  const Moments moments = lognormal_moments(0.3, 0.68);
  CHECK(lognormal.moment(0) == Approx(1));
  CHECK(lognormal.moment(1) == Approx(moments.mean).epsilon(1e-12));
  CHECK(lognormal.moment(2) == Approx(moments.mean * moments.mean + moments.sd * moments.sd).epsilon(1e-12));
  CHECK(lognormal.moment(3) == Approx(std::exp(3 * 0.3 + 4.5 * 0.68 * 0.68)).epsilon(1e-12));

  const SizeLaw normal(normal_psd(10, 1, 1, 19), 3);
  CHECK(normal.moment(3) == Approx(1000 + 3 * 10).epsilon(1e-12));

  const SizeLaw weibull(weibull_psd(5, 2, Weighting::number, 1e-9, 100), 3);
  CHECK(weibull.moment(1) == Approx(5 * std::tgamma(1.5)).epsilon(1e-12));
  CHECK(weibull.moment(4) == Approx(625 * std::tgamma(3.0)).epsilon(1e-12));
}

TEST_CASE("a Rosin-Rammler law returns its volume statement") {
  for (const int dimension : {2, 3}) {
    for (const double shape : {0.7, 1.0, 1.5, 3.0, 8.0}) {
      const Psd psd = weibull_psd(10, shape, Weighting::volume, 1, 40);
      const SizeLaw law(psd, dimension);
      const auto coarser = [&](double r) { return std::exp(-std::pow(r / psd.scale, psd.shape)); };
      for (const double r : {1.0, 2.0, 5.0, 10.0, 20.0, 39.0, 40.0}) {
        CAPTURE(dimension, shape, r);
        const double stated_share = (coarser(1) - coarser(r)) / (coarser(1) - coarser(40));
        CHECK(law.weighted_cdf(r, dimension) == Approx(stated_share).epsilon(1e-12).margin(1e-15));
      }
    }
  }
}

TEST_CASE("a volume histogram returns its weights") {
  const std::vector<double> edges{1, 2, 5, 10, 11};
  const std::vector<double> weights{1, 4, 3, 2};
  for (const int dimension : {2, 3}) {
    const SizeLaw law(histogram_psd(edges, weights, Weighting::volume), dimension);
    CHECK(law.weighted_cdf(2, dimension) == Approx(0.1).epsilon(1e-13));
    CHECK(law.weighted_cdf(5, dimension) == Approx(0.5).epsilon(1e-13));
    CHECK(law.weighted_cdf(7.5, dimension) == Approx(0.65).epsilon(1e-13));
    CHECK(law.weighted_cdf(10, dimension) == Approx(0.8).epsilon(1e-13));
  }
  const SizeLaw by_number(histogram_psd(edges, weights, Weighting::number), 3);
  CHECK(by_number.cdf(2) == Approx(0.1).epsilon(1e-13));
  CHECK(by_number.cdf(7.5) == Approx(0.65).epsilon(1e-13));
}

TEST_CASE("empty bins at the ends of a histogram bound nothing") {
  const SizeLaw law(histogram_psd({0, 1, 2, 3, 4}, {0, 1, 1, 0}, Weighting::volume), 3);
  CHECK(law.smallest() == 1);
  CHECK(law.largest() == 3);
}

TEST_CASE("discrete laws know their classes") {
  const SizeLaw mono(monodisperse_psd(2.5), 3);
  REQUIRE(mono.classes().size() == 1);
  CHECK(mono.quantile(0.3) == 2.5);
  CHECK(mono.moment(3) == Approx(2.5 * 2.5 * 2.5));
  CHECK(mono.cdf(2.4) == 0);
  CHECK(mono.cdf(2.5) == 1);

  for (const int dimension : {2, 3}) {
    for (const double rho : {2.0, 40.0, 100.0}) {
      CAPTURE(dimension, rho);
      const SizeLaw law(bimodal_psd(0.5, rho, 0.75), dimension);
      REQUIRE(law.classes().size() == 2);
      CHECK(law.smallest() == 0.5);
      CHECK(law.largest() == 0.5 * rho);
      CHECK(law.weighted_cdf(1.0 - 1e-3, dimension) == Approx(0.25).epsilon(1e-12));
      CHECK(law.cdf(0.6) == law.class_shares()[0]);
      CHECK(law.class_shares()[0] + law.class_shares()[1] == Approx(1).epsilon(1e-15));
      CHECK(law.quantile(law.class_shares()[0] * 0.999) == 0.5);
      CHECK(law.quantile(law.class_shares()[0]) == 0.5 * rho);
    }
  }
}

TEST_CASE("a bimodal law of one size has one class") {
  CHECK(SizeLaw(bimodal_psd(1, 5, 0), 3).largest() == 1);
  CHECK(SizeLaw(bimodal_psd(1, 5, 1), 3).smallest() == 5);
  CHECK(SizeLaw(bimodal_psd(1, 1, 0.5), 3).classes().size() == 1);
  CHECK(SizeLaw(lognormal_psd(), 3).classes().empty());
}

TEST_CASE("a Weibull law of large shape is nearly monodisperse") {
  for (const Weighting weighting : {Weighting::number, Weighting::volume}) {
    const SizeLaw steep(weibull_psd(1, 500, weighting, 0.01, 100), 3);
    CHECK(steep.quantile(0.5) == Approx(1).epsilon(0.01));
    CHECK(steep.moment(3) == Approx(1).epsilon(0.01));
  }
}

TEST_CASE("impossible statements throw") {
  Psd psd = lognormal_psd(0.30, 1.70);
  psd.mean = 1.30;
  psd.sd = 0.68;
  CHECK_THROWS_AS(SizeLaw(psd, 3), InputError);
  CHECK_THROWS_AS(SizeLaw(lognormal_psd(0.3, -1), 3), InputError);
  CHECK_THROWS_AS(SizeLaw(lognormal_psd(), 4), InputError);
}
