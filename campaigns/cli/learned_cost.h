// What jobs of one method or metric will take, learned from those that have run: time as a power of the number of
// spheres, memory as a line in it.
#pragma once

#include "report/power_law.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tamp {
struct Scene;
}

namespace tamp::cli {

/// One job that has run. `spheres` is what its scene asks for, known before a job runs too (expected_spheres).
struct CostPoint {
  double spheres = 0;
  double wall_s = 0;
  double bytes = 0; ///< largest resident memory; 0: not known
};

/// The stated number of spheres, or about as many as fill the box.
double expected_spheres(const Scene& scene);

/// Time and memory over the number of spheres. Settings of the method beside the size are not told apart: what they
/// do is scatter.
class LearnedCost {
public:
  /// Points whose numbers are not above 0 are left out. With sizes that differ by less than a factor of 2 nothing can
  /// be said of the growth: time is then taken proportional to the number of spheres.
  explicit LearnedCost(std::span<const CostPoint> points);

  [[nodiscard]] std::size_t points() const { return law_.points; }
  /// The exponent, and whether it is assumed instead of fitted.
  [[nodiscard]] double exponent() const { return law_.beta; }
  [[nodiscard]] bool exponent_is_assumed() const { return assumed_; }
  [[nodiscard]] double fewest() const { return law_.n_low; }
  [[nodiscard]] double most() const { return law_.n_high; }

  /// Mean seconds of a job of this many spheres. NaN without points.
  [[nodiscard]] double seconds(double spheres) const;
  /// Standard error of the fit there, of ln t; NaN where the points are too few to say.
  [[nodiscard]] double fit_error(double spheres) const;
  /// Standard deviation of single jobs around the fit, of ln t; NaN as above.
  [[nodiscard]] double scatter() const { return scatter_; }
  /// Student's factor of a 95 % interval.
  [[nodiscard]] double reach() const { return reach_; }
  /// Bytes, at least as many as the least that any point took. NaN if no point knows its memory.
  [[nodiscard]] double bytes(double spheres) const;

private:
  PowerLaw law_;
  bool assumed_ = false;
  double scatter_;
  double reach_;
  double centre_ = 0; ///< mean of ln N
  double spread_ = 0; ///< sum of (ln N - centre)^2
  double bytes_0_;
  double bytes_1_ = 0; ///< per sphere
  double least_bytes_;
};

/// Time of many jobs with its 95 % interval.
class CostSum {
public:
  /// A job that takes `share` of the machine while it runs; jobs of one model share the error of its fit.
  void add(const LearnedCost& cost, double spheres, double share);

  [[nodiscard]] double seconds() const { return seconds_; }
  /// Half the width of the interval of ln seconds; nothing if it is not known of some job.
  [[nodiscard]] std::optional<double> half_width() const;
  /// "about 12 min (8 min to 18 min)"
  [[nodiscard]] std::string text() const;

  CostSum& operator+=(const CostSum& other);

private:
  double seconds_ = 0;
  double from_fit_ = 0;     ///< sum of seconds × error of the fit × reach of this model
  double from_scatter_ = 0; ///< sum of (seconds × scatter × reach)^2
  double others_ = 0;       ///< squares of other models
};

} // namespace tamp::cli
