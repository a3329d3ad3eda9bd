// The longest step that integrates a bed of elastic spheres stably, from stiffness, mass and the time of a collision.
#pragma once

#include "engine/contact/hertz.h"
#include "engine/contact/material.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>

namespace tamp {

/// Steps in the shortest half period of a contact. Velocity Verlet needs two in a full period; a sphere held by a dozen
/// neighbours swings some four times faster than one contact alone; the watch of settle_run.h over energy and overlap
/// catches the rest.
inline constexpr double kStepsPerCollision = 10;

/// Half period π √(m/k) of the contact between two equal spheres of radius r and mass m each, whose stiffness
/// k = 2 E* √(R δ) is taken at the deeper of two overlaps: that of a collision at `speed`, and `overlap` times r.
inline double shortest_collision(double modulus, double r, double mass, double speed, double overlap) {
  const double R = effective(r, r);
  const double m = effective(mass, mass);
  const double deepest = std::max(overlap * r, speed > 0 ? hertz_largest_overlap(modulus, R, m, speed) : 0.0);
  return std::numbers::pi * std::sqrt(m / (2 * modulus * std::sqrt(R * deepest)));
}

/// The longest stable step of spheres of these radii and masses that meet at `speed` at most; see shortest_collision.
inline double stable_step(std::span<const double> radii, std::span<const double> masses, double modulus, double speed,
                          double overlap, double steps_per_collision = kStepsPerCollision) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < radii.size(); ++i)
    shortest = std::min(shortest, shortest_collision(modulus, radii[i], masses[i], speed, overlap));
  return shortest / steps_per_collision;
}

} // namespace tamp
