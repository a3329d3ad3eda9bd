// The longest step that integrates a bed of elastic spheres stably, from stiffness, mass and the time of a collision.
#pragma once

#include "engine/contact/hertz.h"
#include "engine/contact/material.h"

#include <algorithm>
#include <numbers>

namespace tamp {

/// Steps in the shortest half period of a contact. Velocity Verlet needs two in a full period; a sphere held by a dozen
/// neighbours swings some four times faster than one contact alone; the watch of settle_run.h over energy and overlap
/// catches the rest.
inline constexpr double kStepsPerCollision = 20;

/// Half period π √(m/k) of the contact between two equal spheres of radius r and mass m each, whose stiffness
/// k = 2 E* √(R δ) is taken at the deeper of two overlaps: that of a collision at `speed`, and `overlap` times r.
inline double shortest_collision(double modulus, double r, double mass, double speed, double overlap) {
  const double R = effective(r, r);
  const double m = effective(mass, mass);
  const double deepest = std::max(overlap * r, speed > 0 ? hertz_largest_overlap(modulus, R, m, speed) : 0.0);
  return std::numbers::pi * std::sqrt(m / (2 * modulus * std::sqrt(R * deepest)));
}

} // namespace tamp
