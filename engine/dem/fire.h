// A quasi-static minimiser of elastic and gravitational energy: FIRE, for spheres without friction.
#pragma once

#include "engine/dem/verlet.h"

namespace tamp {

/// FIRE 2.0 (Guénolé et al., Comput. Mater. Sci. 175, 109584, 2020; Bitzek et al., PRL 97, 170201, 2006), with its
/// published constants. Masses are the spheres' own, so that a loose cloud falls as one.
struct Fire {
  static constexpr double kGrow = 1.1;
  static constexpr double kShrink = 0.5;
  static constexpr double kMixing = 0.25;
  static constexpr double kMixingDecay = 0.99;
  static constexpr int kDelay = 20;

  double dt;     ///< present step
  double dt_max; ///< a step that is still stable
  double mixing = kMixing;
  std::int64_t downhill = 0; ///< steps since the motion last went uphill

  /// One force evaluation.
  template <int D, class Law>
  void step(State<D, Law>& s, ForceField<D, Law>& field) {
    static_assert(!Law::turns, "friction has no energy to be minimised");
    const std::size_t n = s.count();
    const double power = parallel_sum<double>(n, [&](std::size_t i) { return s.force[i].dot(s.velocity[i]); });
    if (power > 0) {
      if (++downhill > kDelay) {
        dt = std::min(dt * kGrow, dt_max);
        mixing *= kMixingDecay;
      }
    } else {
      if (downhill > 0)
        dt *= kShrink;
      downhill = 0;
      mixing = kMixing;
      parallel_for(n, [&](std::size_t i) {
        s.centre[i] -= 0.5 * dt * s.velocity[i];
        s.velocity[i].setZero();
      });
    }
    parallel_for(n, [&](std::size_t i) { s.velocity[i] += dt / s.mass[i] * s.force[i]; });
    // Mixing in the metric of the masses: v ← (1 − α) v + α |v| a/|a| with |v|² = Σ m v², |a|² = Σ F²/m.
    struct Norms {
      double v = 0;
      double a = 0;
      void operator+=(const Norms& other) {
        v += other.v;
        a += other.a;
      }
    };
    const Norms norms = parallel_sum<Norms>(n, [&](std::size_t i) {
      return Norms{s.mass[i] * s.velocity[i].squaredNorm(), s.force[i].squaredNorm() / s.mass[i]};
    });
    const double turn = norms.a > 0 ? mixing * std::sqrt(norms.v / norms.a) : 0;
    parallel_for(n, [&](std::size_t i) {
      s.velocity[i] = (1 - mixing) * s.velocity[i] + turn / s.mass[i] * s.force[i];
      s.centre[i] += dt * s.velocity[i];
    });
    field.evaluate(s, dt);
  }
};

} // namespace tamp
