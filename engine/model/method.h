// Methods: which generator makes the packing, and its parameters.
#pragma once

#include "engine/model/enum_names.h"

#include <cstdint>
#include <span>

namespace tamp {

enum class MethodName { drop_and_roll, lattice, drop_and_roll_me };
template <>
struct EnumNames<MethodName> {
  static constexpr std::array<std::string_view, 3> value{"drop-and-roll", "lattice", "drop-and-roll-me"};
};

/// What drop-and-roll does with the radius of a sphere that does not fit under the lid.
enum class OnFailure { redraw, keep };
template <>
struct EnumNames<OnFailure> {
  static constexpr std::array<std::string_view, 2> value{"redraw", "keep"};
};

struct DropAndRoll {
  bool lid = true;                          ///< a sphere must end wholly below the top of the box
  OnFailure on_failure = OnFailure::redraw; ///< the paper draws a new radius
  std::int64_t max_failures = 200;          ///< N_max: failures in a row that end the packing
};

enum class LatticeKind { square, hexagonal, sc, bcc, fcc, hcp };
template <>
struct EnumNames<LatticeKind> {
  static constexpr std::array<std::string_view, 6> value{"square", "hexagonal", "sc", "bcc", "fcc", "hcp"};
};

struct Lattice {
  LatticeKind kind = LatticeKind::square;
};

struct MovingEnlarging {
  std::int64_t sweeps = 4; ///< passes of moving and enlarging
};

/// A method with its parameters; only the struct that `name` selects counts.
struct Method {
  MethodName name = MethodName::drop_and_roll;
  DropAndRoll drop_and_roll;
  Lattice lattice;
  MovingEnlarging moving_enlarging;
};

/// Whether a method starts from the packing of another job.
enum class Start {
  scene,   ///< from the scene alone
  either,  ///< from the scene, or from a packing if one is given
  packing, ///< from a packing: it changes what another method has made
};

/// What is known of a method without running it. A revision goes up whenever the same job would give other bytes.
struct MethodInfo {
  MethodName name;
  std::int64_t revision;
  Start start;
  std::string_view summary;
};

std::span<const MethodInfo> methods();
const MethodInfo& info(MethodName name);

} // namespace tamp
