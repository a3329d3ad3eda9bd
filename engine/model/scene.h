// Scene: what is wanted — a powder, a box and its sides — without saying how it is made.
#pragma once

#include "engine/model/enum_names.h"
#include "engine/model/psd.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tamp {

enum class Sides { walls, periodic };
template <>
struct EnumNames<Sides> {
  static constexpr std::array<std::string_view, 2> value{"walls", "periodic"};
};

enum class LengthUnit { nm, um, mm, m };
template <>
struct EnumNames<LengthUnit> {
  static constexpr std::array<std::string_view, 4> value{"nm", "um", "mm", "m"};
};

/// The length in metres.
double metres(LengthUnit unit);

/// All lengths are numbers in `unit`; nothing in the engine depends on which unit that is.
struct Scene {
  std::int64_t dimension = 3;       ///< 2 or 3
  LengthUnit unit = LengthUnit::um; ///< of every length of the scene and of its packings
  std::vector<double> size;         ///< box edges; one number means equal edges. The last axis is vertical.
  Sides sides = Sides::walls;       ///< of the lateral axes; the floor is always a wall
  std::int64_t count = 0;           ///< number of particles; 0: as many as fit
  Psd psd;
  Sampler sampler = Sampler::random;
};

/// One impossible value: the path of the parameter inside its root, and what is wrong with it.
struct Problem {
  std::string path;
  std::string message;
};

/// Longest box edge in units of the smallest radius. Coordinates carry a rounding of 1e-16 of the edge; at this limit
/// that is as much as a contact's tolerance. Drop-and-roll still loses no equal spheres there, but many from 1e6 on.
inline constexpr double kLongestBox = 1e5;

/// Spheres a box may make room for.
inline constexpr double kMostSpheres = 1e9;

/// Packing fraction assumed where the number of spheres must be guessed before they are drawn.
inline constexpr double kGuessedPhi = 0.6;

class SizeLaw;

/// About as many spheres of the law as fill the box of a completed scene.
double full_box_count(const Scene& scene, const SizeLaw& law);

/// The scene in its one canonical form: `size` has `dimension` numbers, the law its own parameters.
Scene completed(Scene scene);

/// Everything impossible about the values of a completed scene taken together; empty when it can be built.
std::vector<Problem> problems(const Scene& scene);

} // namespace tamp
