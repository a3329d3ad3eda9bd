// Rods on a line: the longest first, each into the widest gap.
#include "engine/model/random_close_packing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <vector>

namespace tamp {

namespace {

constexpr double kFarrGroot = 0.7654; // least gap in lengths of the shorter of two rods
constexpr double kDiscs = 0.84;

/// Sizes and rods that stand for the law; with 1e5 of each the estimate is settled to three decimals.
constexpr std::size_t kSamples = 100000;

/// Fractional parts of its multiples fill [0, 1) evenly.
constexpr double kGoldenRatio = 0.61803398874989485;

} // namespace

double random_close_packing(const SizeLaw& law, int dimension) {
  if (dimension == 2)
    return kDiscs;
  // A line meets a sphere of diameter D with a probability as its section D², and cuts from it a rod of length L with
  // P(L) ∝ L up to D.
  const auto share = [](std::size_t i) { return (static_cast<double>(i) + 0.5) / static_cast<double>(kSamples); };
  std::vector<double> diameters(kSamples);
  std::vector<double> section(kSamples);
  double sum = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    // Large spheres are few and fill much: samples crowd towards the upper end of the law, P(above) = (1 − s)⁴.
    const double left = 1 - share(i);
    diameters[i] = 2 * law.quantile(1 - std::pow(left, 4));
    section[i] = sum += std::pow(left, 3) * diameters[i] * diameters[i];
  }
  std::vector<double> rods(kSamples);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const auto at = std::upper_bound(section.begin(), section.end() - 1, share(i) * sum) - section.begin();
    const double turn = kGoldenRatio * static_cast<double>(i);
    rods[i] = diameters[static_cast<std::size_t>(at)] * std::sqrt(turn - std::floor(turn));
  }
  std::sort(rods.begin(), rods.end(), std::greater<>());

  std::priority_queue<double> gaps;
  gaps.push(kFarrGroot * rods.front());
  double solid = rods.front();
  double empty = kFarrGroot * rods.front();
  for (std::size_t i = 1; i < kSamples; ++i) {
    const double least = kFarrGroot * rods[i];
    const double widest = gaps.top();
    gaps.pop();
    const double rest = std::max(widest - rods[i] - least, least);
    gaps.push(least);
    gaps.push(rest);
    solid += rods[i];
    empty += least + rest - widest;
  }
  return solid / (solid + empty);
}

} // namespace tamp
