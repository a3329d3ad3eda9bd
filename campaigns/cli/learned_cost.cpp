// Fits time and memory, and adds errors up.
#include "campaigns/cli/learned_cost.h"

#include "campaigns/cli/estimate.h"
#include "engine/model/scene.h"
#include "engine/model/size_law.h"

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tamp::cli {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// Sizes closer together than this say nothing about growth.
constexpr double kSameSize = 2;

/// t = c N with c the geometric mean of t/N.
PowerLaw proportional(std::span<const PowerPoint> points) {
  PowerLaw law;
  law.points = points.size();
  law.beta = 1;
  double sum = 0;
  for (const PowerPoint& point : points) {
    law.n_low = std::fmin(law.n_low, point.n);
    law.n_high = std::fmax(law.n_high, point.n);
    sum += std::log(point.t / point.n);
  }
  law.a = std::exp(sum / static_cast<double>(points.size()));
  for (const PowerPoint& point : points)
    law.residuals.push_back(std::log(point.t / law.time(point.n)));
  return law;
}

bool differ_in_size(std::span<const PowerPoint> points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const PowerPoint& a, const PowerPoint& b) { return a.n < b.n; });
  return low != points.end() && high->n >= kSameSize * low->n;
}

} // namespace

double expected_spheres(const Scene& scene) {
  if (scene.count > 0)
    return static_cast<double>(scene.count);
  return full_box_count(scene, SizeLaw(scene.psd, static_cast<int>(scene.dimension)));
}

LearnedCost::LearnedCost(std::span<const CostPoint> points)
    : scatter_(kNone), reach_(kNone), bytes_0_(kNone), least_bytes_(kNone) {
  std::vector<PowerPoint> times;
  for (const CostPoint& point : points) {
    if (point.spheres > 0 && point.wall_s > 0)
      times.push_back({point.spheres, point.wall_s});
  }
  if (times.empty())
    return;
  assumed_ = !differ_in_size(times);
  law_ = assumed_ ? proportional(times) : fit_power_law(times);
  const auto n = static_cast<double>(times.size());
  for (const PowerPoint& point : times)
    centre_ += std::log(point.n) / n;
  double squares = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    spread_ += std::pow(std::log(times[i].n) - centre_, 2);
    squares += std::pow(law_.residuals[i], 2);
  }
  if (const double freedom = n - (assumed_ ? 1 : 2); freedom > 0) {
    constexpr double kTail = 0.025;
    scatter_ = std::sqrt(squares / freedom);
    reach_ = boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), kTail));
  }

  // Least squares of bytes = b0 + b1 N: a program's own memory, and that of its spheres.
  double m = 0;
  double mean_n = 0;
  double mean_b = 0;
  for (const CostPoint& point : points) {
    if (point.spheres > 0 && point.bytes > 0) {
      ++m;
      mean_n += point.spheres;
      mean_b += point.bytes;
      least_bytes_ = std::fmin(least_bytes_, point.bytes);
    }
  }
  if (m == 0)
    return;
  mean_n /= m;
  mean_b /= m;
  double nn = 0;
  double nb = 0;
  for (const CostPoint& point : points) {
    if (point.spheres > 0 && point.bytes > 0) {
      nn += std::pow(point.spheres - mean_n, 2);
      nb += (point.spheres - mean_n) * (point.bytes - mean_b);
    }
  }
  bytes_1_ = nn > 0 ? std::max(nb / nn, 0.0) : 0.0;
  bytes_0_ = mean_b - bytes_1_ * mean_n;
}

double LearnedCost::seconds(double spheres) const {
  // The mean of a lognormal scatter around the median that the fit gives.
  return law_.time(spheres) * (std::isnan(scatter_) ? 1 : std::exp(scatter_ * scatter_ / 2));
}

double LearnedCost::fit_error(double spheres) const {
  const double n = static_cast<double>(law_.points);
  const double slope = assumed_ ? 0 : std::pow(std::log(spheres) - centre_, 2) / spread_;
  return scatter_ * std::sqrt(1 / n + slope);
}

double LearnedCost::bytes(double spheres) const {
  return std::isnan(bytes_0_) ? bytes_0_ : std::max(bytes_0_ + bytes_1_ * spheres, least_bytes_);
}

void CostSum::add(const LearnedCost& cost, double spheres, double share) {
  const double seconds = share * cost.seconds(spheres);
  seconds_ += seconds;
  from_fit_ += seconds * cost.fit_error(spheres) * cost.reach();
  from_scatter_ += std::pow(seconds * cost.scatter() * cost.reach(), 2);
}

CostSum& CostSum::operator+=(const CostSum& other) {
  seconds_ += other.seconds_;
  others_ += other.others_ + other.from_fit_ * other.from_fit_ + other.from_scatter_;
  return *this;
}

std::optional<double> CostSum::half_width() const {
  const double squares = from_fit_ * from_fit_ + from_scatter_ + others_;
  if (!(seconds_ > 0) || std::isnan(squares))
    return std::nullopt;
  return std::sqrt(squares) / seconds_;
}

std::string CostSum::text() const {
  const std::string about = "about " + in_words(seconds_);
  const std::optional<double> half = half_width();
  if (!half)
    return about + " (too few records to say how sure)";
  return fmt::format("{} ({} to {})", about, in_words(seconds_ * std::exp(-*half)),
                     in_words(seconds_ * std::exp(*half)));
}

} // namespace tamp::cli
