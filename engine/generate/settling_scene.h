// What a method that settles spheres under gravity starts from: spheres in their places, and the task in units of the
// bed; shared by the native engine and LAMMPS, so that both are given the same physics.
#pragma once

#include "engine/dem/settle.h"
#include "engine/generate/generator.h"
#include "engine/generate/loose_cloud.h"

#include <span>
#include <string>

namespace tamp {

/// Units in which the mean radius, the density and gravity are 1.
struct BedUnits {
  double length = 1;   ///< in the scene's unit
  double metre = 1;    ///< of that, in metres
  double pressure = 1; ///< Pa
  double time = 1;     ///< s
};

/// Spheres of the job's scene in a loose cloud above its floor, or its parent's where they are, and what is to be done
/// with them.
template <int D>
struct SettlingScene {
  std::string obstacle; ///< why nothing can settle; empty if the rest counts
  LengthUnit unit = LengthUnit::um;
  Vec<D> size = Vec<D>::Zero();
  std::array<bool, D> periodic{};
  Cloud<D> cloud; ///< in the scene's unit
  BedUnits units;
  double tabor = 0; ///< of the mean radius

  explicit SettlingScene(const Request& request);

  /// In BedUnits. Contacts are softer than the material's: as soft as some multiple of the tolerated overlap allows,
  /// larger where energy is minimised, unless motion is `always_in_time`.
  [[nodiscard]] SettleTask<D> task(const Request& request, bool always_in_time = false);

  /// The settled bed in the scene's unit and box, from centres in BedUnits; periodic images are taken into the box.
  [[nodiscard]] Packing packing(std::span<const Vec<D>> centres) const;
};

extern template struct SettlingScene<2>;
extern template struct SettlingScene<3>;

} // namespace tamp
