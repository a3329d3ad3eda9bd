// Expected Hellinger distances of random samples.
#include "engine/measure/sampling_floor.h"

#include "engine/base/random.h"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tamp {

namespace {

/// Terms of a binomial sum below this share of the largest one are left out.
constexpr double kNegligible = 1e-20;

/// A bin with more spheres than this has a sum of r^power that is normal for every purpose; others are drawn one by
/// one.
constexpr std::uint64_t kFew = 64;

/// Repetitions of the simulation: as many as this many draws allow, within bounds.
constexpr double kDraws = 1e6;
constexpr double kMostRepetitions = 512;
constexpr double kLeastRepetitions = 4;

/// Expected value of f(X) for X binomial with n trials of probability q, 0 < q < 1. The weights run up and down from
/// the most likely X by their ratio, so no factorial is needed.
template <class F>
double binomial_mean(double q, double n, F&& f) {
  const double mode = std::min(n, std::floor((n + 1) * q));
  double weights = 1;
  double sum = f(mode);
  double weight = 1;
  for (double x = mode; x < n && weight > kNegligible; ++x) {
    weight *= (n - x) / (x + 1) * q / (1 - q);
    weights += weight;
    sum += weight * f(x + 1);
  }
  weight = 1;
  for (double x = mode; x > 0 && weight > kNegligible; --x) {
    weight *= x / (n - x + 1) * (1 - q) / q;
    weights += weight;
    sum += weight * f(x - 1);
  }
  return sum / weights;
}

/// How many of n trials of probability p succeed, by inversion of u.
std::uint64_t binomial_draw(std::uint64_t n, double p, double u) {
  if (n == 0 || p <= 0)
    return 0;
  if (p >= 1)
    return n;
  constexpr double kShortSearch = 20; // mean up to which a search from 0 is fast and free of underflow
  const auto trials = static_cast<double>(n);
  if (trials * p > kShortSearch) {
    using namespace boost::math::policies;
    using Policy = policy<discrete_quantile<integer_round_up>>;
    return static_cast<std::uint64_t>(quantile(boost::math::binomial_distribution<double, Policy>(trials, p), u));
  }
  double weight = std::exp(trials * std::log1p(-p));
  double below = weight;
  std::uint64_t x = 0;
  while (u >= below && x < n && weight > 0) {
    weight *= (trials - static_cast<double>(x)) / static_cast<double>(x + 1) * p / (1 - p);
    below += weight;
    ++x;
  }
  return x;
}

/// sqrt(E[H²]) for a law of one or two sizes: the number of large spheres is binomial.
double floor_of_sizes(const SizeLaw& law, std::span<const double> expected, int power, std::uint64_t n) {
  if (expected.size() == 1)
    return 0;
  const auto trials = static_cast<double>(n);
  const double ratio = std::pow(law.largest() / law.smallest(), power);
  return std::sqrt(binomial_mean(law.class_shares()[1], trials, [&](double large) {
    const double share = large * ratio / (large * ratio + trials - large);
    const double h = hellinger_distance(std::array{1 - share, share}, 0, expected);
    return h * h;
  }));
}

/// One bin of a continuous law: what a number of draws that fell into it add up to.
struct Bin {
  double share = 0;   // by number
  double later = 0;   // share of this bin and those after it
  double first_u = 0; // the law's cdf at the lower edge
  double mean = 0;    // of (r/largest)^power in the bin
  double sd = 0;
};

std::vector<Bin> bins_of(const SizeLaw& law, const SizeBins& bins, int power) {
  std::vector<Bin> rows(bins.count());
  const auto shares = bins.shares(0);
  const auto once = bins.shares(power);
  const auto twice = bins.shares(2 * power);
  const double scale = std::pow(law.largest(), power);
  double later = 0;
  for (std::size_t b = rows.size(); b-- > 0;) {
    Bin& row = rows[b];
    row.share = shares[b];
    later += shares[b];
    row.later = later;
    row.first_u = law.cdf(bins.edge(b));
    if (row.share <= 0)
      continue;
    row.mean = once[b] * (law.moment(power) / scale) / row.share;
    const double square = twice[b] * (law.moment(2 * power) / scale / scale) / row.share;
    row.sd = std::sqrt(std::max(0.0, square - row.mean * row.mean));
  }
  return rows;
}

/// Sum of (r/largest)^power over `count` draws inside the bin.
double bin_sum(const SizeLaw& law, const Bin& bin, int power, std::uint64_t count, RandomStream& draw) {
  const auto n = static_cast<double>(count);
  if (count > kFew) {
    constexpr double kTwoPi = 6.283185307179586;
    const double radius = std::sqrt(-2 * std::log(1 - draw.uniform())); // Box & Muller
    const double gauss = radius * std::cos(kTwoPi * draw.uniform());
    return std::max(0.0, n * bin.mean + std::sqrt(n) * bin.sd * gauss);
  }
  double sum = 0;
  for (std::uint64_t k = 0; k < count; ++k)
    sum += std::pow(law.quantile(bin.first_u + draw.uniform() * bin.share) / law.largest(), power);
  return sum;
}

} // namespace

double hellinger_distance(std::span<const double> p, double outside, std::span<const double> q) {
  double sum = outside;
  for (std::size_t b = 0; b < p.size(); ++b) {
    const double root = std::sqrt(p[b]) - std::sqrt(q[b]);
    sum += root * root;
  }
  return std::min(1.0, std::sqrt(sum / 2));
}

double number_floor(std::span<const double> shares, std::uint64_t n) {
  double sum = 0;
  for (const double q : shares) {
    if (q <= 0 || q >= 1)
      continue;
    const auto trials = static_cast<double>(n);
    sum += binomial_mean(q, trials, [&](double x) {
      const double root = std::sqrt(x / trials) - std::sqrt(q);
      return root * root;
    });
  }
  return std::sqrt(sum / 2);
}

double weighted_floor(const SizeLaw& law, const SizeBins& bins, int power, std::uint64_t n) {
  const auto expected = bins.shares(power);
  if (bins.discrete())
    return floor_of_sizes(law, expected, power, n);
  const auto rows = bins_of(law, bins, power);
  double work = 0; // draws of one repetition
  for (const Bin& row : rows)
    work += 1 + std::min(static_cast<double>(kFew), row.share * static_cast<double>(n));
  const auto repetitions = static_cast<std::uint64_t>(std::clamp(kDraws / work, kLeastRepetitions, kMostRepetitions));

  double squares = 0;
  for (std::uint64_t k = 0; k < repetitions; ++k) {
    RandomStream draw("sampling floor of the Hellinger distance", k);
    std::vector<double> sums(rows.size(), 0);
    std::uint64_t left = n;
    double total = 0;
    for (std::size_t b = 0; b < rows.size() && left > 0; ++b) { // multinomial counts, one binomial after the other
      if (rows[b].share <= 0)
        continue;
      const std::uint64_t count = binomial_draw(left, rows[b].share / rows[b].later, draw.uniform());
      left -= count;
      sums[b] = bin_sum(law, rows[b], power, count, draw);
      total += sums[b];
    }
    for (double& sum : sums)
      sum /= total;
    const double h = hellinger_distance(sums, 0, expected);
    squares += h * h;
  }
  return std::sqrt(squares / static_cast<double>(repetitions));
}

} // namespace tamp
