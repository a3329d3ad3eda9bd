// The pairs and walls that may touch within the next steps, in one order that depends on nothing but who is near whom.
#pragma once

#include "engine/search/contact_search.h"

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace tamp {

/// Sphere i and the image of sphere j > i that lies `image` periods away. Ordered by i, then j, then image.
template <int D>
struct NearPair {
  std::uint32_t i = 0;
  std::uint32_t j = 0;
  std::array<std::int8_t, D> image{};

  friend bool operator==(const NearPair&, const NearPair&) = default;
  friend bool operator<(const NearPair& a, const NearPair& b) {
    return std::tie(a.i, a.j, a.image) < std::tie(b.i, b.j, b.image);
  }
};

/// Sphere i and the wall across `axis` at 0 (side 0) or at the far end (side 1).
struct NearWall {
  std::uint32_t i = 0;
  std::uint8_t axis = 0;
  std::uint8_t side = 0;

  friend bool operator==(const NearWall&, const NearWall&) = default;
  friend bool operator<(const NearWall& a, const NearWall& b) {
    return std::tie(a.i, a.axis, a.side) < std::tie(b.i, b.axis, b.side);
  }
};

/// Every pair and wall whose gap is at most the sum of two margins, one of each sphere (a wall's is 0). A sphere's
/// margin is the `hold` by which its contacts outlast touching, plus `skin`, the same length for all: while no sphere
/// has moved further than the skin, apart from what all have moved alike and what the box took along as it shrank, the
/// list has every pair that can touch.
/// Contacts of a sphere with its own image are left out: their forces cancel.
template <int D>
class CandidateList {
public:
  /// hold: one number a sphere. All lengths in one unit; skin > 0.
  void build(const SearchBox<D>& box, std::span<const Vec<D>> centres, std::span<const double> radii,
             std::span<const double> hold, double skin);

  /// Whether some sphere has moved too far since the list was built, in a box that now has this size.
  [[nodiscard]] bool stale(const Vec<D>& size, std::span<const Vec<D>> centres) const;

  [[nodiscard]] std::span<const NearPair<D>> pairs() const { return pairs_; }
  [[nodiscard]] std::span<const NearWall> walls() const { return walls_; }

private:
  std::vector<NearPair<D>> pairs_;
  std::vector<NearWall> walls_;
  std::vector<Vec<D>> built_at_;
  std::vector<double> bare_; // radius with hold
  Vec<D> built_size_ = Vec<D>::Zero();
  double skin_ = 0;
  bool has_wall_ = false; // a wall does not move with the spheres
};

extern template class CandidateList<2>;
extern template class CandidateList<3>;

} // namespace tamp
