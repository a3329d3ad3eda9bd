// The radii that every generator draws: one sequence, at random or stratified, with exact counts for discrete laws.
#pragma once

#include "engine/base/random.h"
#include "engine/model/size_law.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tamp {

/// An endless sequence of radii of a law, a pure function of (law, kind, block, stream).
///
/// - `random`: independent draws by inverse transform.
/// - `stratified`: blocks of `block` draws, one from each equal-probability stratum, at a uniform place inside it, in
///   random order. A whole block follows the law to within one sphere at every size.
/// - discrete laws (monodisperse, bimodal): both kinds alike draw exact class counts in random order. After each
///   block the count of a class is n times its share to within half a sphere.
class RadiusSampler {
public:
  /// block >= 1 (8 bytes of memory a draw where blocks are used); else InputError.
  RadiusSampler(const SizeLaw& law, Sampler kind, std::uint64_t block, RandomStream stream);

  double next();
  /// Radii handed out so far.
  [[nodiscard]] std::uint64_t drawn() const { return drawn_; }

private:
  void fill_strata();
  void fill_classes();
  void shuffle();

  SizeLaw law_;
  std::uint64_t block_;
  RandomStream stream_;
  bool independent_; // draws need no block
  std::uint64_t drawn_ = 0;
  std::vector<double> radii_; // the current block
};

/// n radii as one block: for methods that know their number of spheres.
[[nodiscard]] std::vector<double> draw_radii(const SizeLaw& law, Sampler kind, std::size_t n, RandomStream stream);

} // namespace tamp
