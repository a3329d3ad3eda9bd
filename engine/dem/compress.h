// Isostatic compression of spheres in a periodic box: until they jam, or at a prescribed packing fraction.
#pragma once

#include "engine/base/vec.h"
#include "engine/dem/effects.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <vector>

namespace tamp {

/// What to compress. Lengths in any unit; without friction and adhesion that is all, else the contacts' numbers are in
/// any units consistent with it.
template <int D>
struct CompressTask {
  Vec<D> size;                   ///< box at the start; its shape stays
  std::vector<double> positions; ///< D numbers a sphere, of any place; overlaps are allowed
  std::vector<double> radii;

  double target_phi = std::numeric_limits<double>::quiet_NaN(); ///< NaN: until jammed
  double overlap = 1e-4;  ///< largest overlap tolerated at the end, relative to the smaller radius
  double pressure = 1e-2; ///< of the compression, in units of the contacts' modulus: the order of relative overlaps;
                          ///< not of spheres that rub or adhere
  double rate = 1e-3;     ///< the box edge shrinks by at most this share in one step
  double force_balance = 2e-2; ///< a stage ends when the rms net force of a sphere is this many mean contact forces
  double stop_strain = 1e-4;   ///< it also ends when the volume changes by less than this share in 100 evaluations

  ContactEffects effects = {};
  bool in_time = false;       ///< follow the motion also where there is neither friction nor adhesion
  double load = 1;            ///< pressure on the box, of spheres that rub or adhere
  double modulus = 0;         ///< their E* to start with
  double largest_modulus = 0; ///< contacts are stiffened up to this where they overlap too much
  double poisson = 0.3;       ///< of both bodies of a contact
  double friction = 0;        ///< Coulomb's μ
  double adhesion = 0;        ///< W

  std::filesystem::path checkpoint = {}; ///< file to keep the state in and to go on from; empty: none
  double checkpoint_every_s = 60;        ///< wall-clock seconds
  std::function<void()> progress{};      ///< called now and then
};

enum class CompressEnd {
  done,    ///< overlaps are within the tolerance; without a target the spheres are jammed
  jammed,  ///< the target cannot be reached this way: jammed below it under pressure, or at it with too much overlap
  gave_up, ///< too many evaluations
};

template <int D>
struct Compressed {
  CompressEnd end = CompressEnd::gave_up;
  Vec<D> size = Vec<D>::Zero();
  std::vector<double> positions; ///< in the box
  double phi = 0;                ///< volume of the spheres over that of the box; overlaps count twice
  double overlap = 0;            ///< largest, relative to the smaller radius
  double pressure = 0; ///< in units of the contacts' modulus; of spheres that rub or adhere in those of the task
  double modulus = 0;  ///< E* at the end, of spheres that rub or adhere
  std::int64_t stiffenings = 0; ///< times their contacts were made stiffer
  std::int64_t halvings = 0;    ///< steps found unstable, halved, and redone from the last good look
  double force_balance = 0;     ///< rms net force of the spheres that are touched, in mean contact forces
  std::int64_t evaluations = 0; ///< of all forces
  std::int64_t list_rebuilds = 0;
  std::int64_t list_repairs = 0;
};

/// Compresses. The result has the same bits on any number of threads, and however often the work was cut off and taken
/// up again from its checkpoint. Throws Error if the box becomes too narrow for its largest sphere.
template <int D>
Compressed<D> compress(const CompressTask<D>& task);

extern template Compressed<2> compress(const CompressTask<2>&);
extern template Compressed<3> compress(const CompressTask<3>&);

} // namespace tamp
