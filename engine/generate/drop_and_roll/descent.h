// The descent of one sphere onto a bed: it falls and rolls, always by steepest descent of its centre, until it is
// stable.
#pragma once

#include "engine/base/vec.h"
#include "engine/generate/drop_and_roll/constraint.h"
#include "engine/generate/drop_and_roll/path.h"
#include "engine/generate/drop_and_roll/support.h"
#include "engine/search/hierarchical_grid.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace tamp {

/// Largest overlap, relative to the smaller radius, that a placed sphere may have with anything; placements are checked
/// against it one by one. The promise to the user is 1e-10.
inline constexpr double kPlacedOverlap = 5e-11;

/// Quasi-static motion of a single sphere over fixed ones in a box with a floor at height 0 and walls or periodic
/// lateral sides. The motion is that of Hitti and Bernacki (Appl. Math. Model. 37, 2013): the velocity is the
/// projection of gravity on the cone that the touching contacts leave free, so every path is a vertical fall or a
/// circular arc.
template <int D>
class Descent {
public:
  enum class End {
    stable,     ///< supported by contacts that can all press, or balanced on fewer with nowhere lower to go
    unresolved, ///< rounding left no admissible motion; the position must not be used
  };

  Descent(const Vec<D>& size, const std::array<bool, D>& periodic, const HierarchicalGrid<D>& grid);

  /// Moves a sphere of the given radius from p down to rest. p must not overlap the bed by more than rounding.
  /// On periodic axes the result may lie outside the box. The height of p never increases by more than kTouch·radius
  /// from event to event.
  End run(Vec<D>& p, double radius);

  /// The same motion event by event, to be watched: `begin`, then `advance` until it tells the end; in between
  /// `position` is where the sphere has come, on the path that its last event ended.
  void begin(const Vec<D>& p, double radius);
  std::optional<End> advance();
  [[nodiscard]] const Vec<D>& position() const { return p_; }

  /// Events (contacts, departures) handled since construction, to compare cost with.
  [[nodiscard]] std::uint64_t events() const { return events_; }

private:
  enum class Step { moved, stable, stuck };

  void gather();
  Step step();
  bool is_supported(bool firmly) const;
  bool is_balanced() const;
  bool is_idle();
  bool fall_is_free() const;
  bool passes_between() const;
  Step fall();
  bool choose_path(Path<D>& path, Support<D>& guide) const;
  bool admissible(const Support<D>& support) const;
  bool make_path(const Support<D>& support, int side, Path<D>& path) const;
  bool is_blocked(const Path<D>& path, const Support<D>& guide) const;
  Step follow(const Path<D>& path, const Support<D>& guide);
  void drop_contacts(const Support<D>& guide);
  void add_touching(const Constraint<D>& constraint);
  bool is_touching(const Constraint<D>& constraint) const;
  bool overlaps_nothing() const;

  Vec<D> size_;
  std::array<bool, D> periodic_;
  const HierarchicalGrid<D>& grid_;

  Vec<D> p_ = Vec<D>::Zero();
  double radius_ = 0;
  Vec<D> gathered_at_ = Vec<D>::Zero();
  double gathered_reach_ = 0;
  double reach_ = 0;                    // gathered_reach_ in radii
  std::vector<Constraint<D>> near_;     // everything p can touch while it stays within gathered_reach_ of gathered_at_
  std::vector<Constraint<D>> touching_; // contacts at p
  std::vector<Vec<D>> normals_;         // of touching_
  double lowest_ = 0;                   // height that p has certainly come down to
  int idle_ = 0;                        // events since
  std::uint64_t events_ = 0;
};

extern template class Descent<2>;
extern template class Descent<3>;

} // namespace tamp
