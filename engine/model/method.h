// Methods: which generator makes the packing, and its parameters.
#pragma once

#include "engine/model/enum_names.h"
#include "engine/model/psd.h"

#include <cstdint>
#include <span>

namespace tamp {

enum class MethodName {
  drop_and_roll,
  lattice,
  drop_and_roll_me,
  dem_gravity,
  dem_isostatic,
  lammps_gravity,
  lammps_isostatic
};
template <>
struct EnumNames<MethodName> {
  static constexpr std::array<std::string_view, 7> value{"drop-and-roll",   "lattice",       "drop-and-roll-me",
                                                         "dem-gravity",     "dem-isostatic", "lammps-gravity",
                                                         "lammps-isostatic"};
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
  std::int64_t sweeps = 5; ///< passes of moving and enlarging
};

/// Which law of adhesion acts where there is adhesion.
enum class AdhesionModel { tabor, jkr, dmt };
template <>
struct EnumNames<AdhesionModel> {
  static constexpr std::array<std::string_view, 3> value{"tabor", "jkr", "dmt"};
};

/// What a particle of a 2D scene is: a disc, or a sphere held in the plane (pseudo-2D). It decides mass and inertia.
enum class FlatBody { disc, sphere };
template <>
struct EnumNames<FlatBody> {
  static constexpr std::array<std::string_view, 2> value{"disc", "sphere"};
};

/// Which effects of a scene are simulated. called_for: those that its numbers ask for; without friction and adhesion
/// energy is minimised. in_time: the same effects, but motion is always followed. all: every effect there is, also
/// those whose numbers are 0, to show what it saves to leave them out.
enum class Simulate { called_for, in_time, all };
template <>
struct EnumNames<Simulate> {
  static constexpr std::array<std::string_view, 3> value{"called-for", "in-time", "all"};
};

/// The powder's material and what its contacts do, in SI units; the defaults are a metal powder (steel) without
/// adhesion and friction.
struct Material {
  double young = 2e11;      ///< E, Pa
  double poisson = 0.3;     ///< ν
  double density = 7800;    ///< kg/m³
  double friction = 0;      ///< Coulomb's μ; 0: no friction, hence no rotation
  double restitution = 0.5; ///< e
  double adhesion = 0;      ///< work of adhesion W, J/m²; 0: none
  AdhesionModel adhesion_model = AdhesionModel::tabor;
  Simulate simulate = Simulate::called_for;
};

struct DemGravity {
  double gravity = 9.81;                 ///< m/s²
  FlatBody flat_body = FlatBody::sphere; ///< 2D scenes only; the paper's choice
  double cloud_phi = 0.2;                ///< packing fraction of the loose cloud that settles
  double overlap = 1e-3;                 ///< largest overlap of the bed, relative to the smaller radius
  double force_balance = 5e-3;           ///< rms net force of a sphere in mean contact forces at which the bed rests
  double steps_per_collision = 10;       ///< time steps in the collision time of the stiffest, lightest pair
  double kinetic_energy = 1e-4;          ///< mean per sphere in units of its weight times the mean radius
};

/// What the real LAMMPS needs to be told besides what dem-gravity does.
struct LammpsGravity {
  double height_drift = 1e-3;  ///< change of the mean height at which it counts as a plateau, in mean radii
  double contact_drift = 1e-2; ///< the same for the contacts of a sphere
};

struct DemIsostatic {
  double target_phi = unstated;    ///< packing fraction to stop at; not stated: compress until jammed
  double start_phi = 0.5;          ///< of the spheres thrown into the box at random, without friction and adhesion
  double overlap_tolerance = 1e-4; ///< largest overlap of the packing, relative to the smaller radius
  double force_tolerance = 2e-2;   ///< rms net force over the mean contact force at which forces balance
  double pressure = 1e-2;          ///< of the compression, in units of the contacts' modulus
  double rate = 1e-3;              ///< largest share by which the box edge shrinks in one step of the minimiser
  double load = 1e3;               ///< pressure on the box, Pa; of spheres that rub or adhere
  double stop_strain = 1e-4;       ///< change of the volume in 100 evaluations at which the box is at rest
};

/// A method with its parameters; only the struct that `name` selects counts.
struct Method {
  MethodName name = MethodName::drop_and_roll;
  DropAndRoll drop_and_roll;
  Lattice lattice;
  MovingEnlarging moving_enlarging;
  Material material;      ///< of the methods that know forces
  DemGravity dem_gravity; ///< of lammps-gravity, too
  LammpsGravity lammps_gravity;
  DemIsostatic dem_isostatic;
  bool hard = false; ///< of discrete element methods: widen the box at the end until nothing overlaps
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
