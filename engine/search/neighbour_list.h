// Neighbour list for spheres of any sizes that move: for each sphere the larger ones that it may touch before the list
// is next brought up to date.
#pragma once

#include "engine/base/vec.h"
#include "engine/search/size_class_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tamp {

/// One entry: the other sphere and which of its periodic images is meant.
class Neighbour {
public:
  Neighbour() = default;
  Neighbour(std::uint32_t index, std::uint32_t image) : bits_(index << kImageBits | image) {}
  [[nodiscard]] std::uint32_t index() const { return bits_ >> kImageBits; }
  [[nodiscard]] std::uint32_t image() const { return bits_ & ((1U << kImageBits) - 1); }
  bool operator==(const Neighbour&) const = default;

  static constexpr std::uint32_t kImageBits = 5;
  static constexpr std::size_t kMostSpheres = std::size_t{1} << (32U - kImageBits);

private:
  std::uint32_t bits_ = 0;
};

/// What update() had to do.
enum class ListUpdate {
  none,     ///< every list is as it was
  repaired, ///< lists of some spheres changed
  rebuilt,  ///< all lists are new, and positions were wrapped into the box
};

/// Every sphere has a margin of `skin` times its radius: a pair is listed if the spheres, each enlarged by its margin,
/// overlap, and the list stays complete while no sphere leaves its margin. The smaller sphere of a pair holds the entry
/// (of equal ones that of the smaller index), so that a list has about as many entries whatever the size ratio. What a
/// sphere may move is measured against its own radius, in coordinates that shrink with the box; spheres that moved
/// further are taken out and put in again one by one (repair), and only when many have is everything rebuilt.
template <int D>
class NeighbourList {
public:
  /// radii: above 0, in the order of the positions; they are copied. skin: above 0; 0.05 to 0.2 make sense. More than
  /// Neighbour::kMostSpheres spheres: Error.
  NeighbourList(const std::array<bool, D>& periodic, std::span<const double> radii, double skin);

  /// Makes the list hold every pair that touches or overlaps at these positions (D numbers a sphere) in a box of this
  /// size, each once. Between updates neither positions nor size may jump: a caller who changes a sphere's image calls
  /// rebuild. Throws Error if a sphere with its margin does not fit into a periodic box.
  ListUpdate update(const Vec<D>& size, std::span<double> positions);

  /// The same from scratch; positions on periodic axes are wrapped into [0, size).
  void rebuild(const Vec<D>& size, std::span<double> positions);

  /// The larger spheres that i may touch. The order is a function of the input, not of the number of threads.
  [[nodiscard]] std::span<const Neighbour> of(std::size_t i) const { return {list_.data() + begin_[i], length_[i]}; }

  /// What to add to the position of a neighbour of that image: sphere i sees j at x_j + shift(image).
  [[nodiscard]] const Vec<D>& shift(std::uint32_t image) const { return shifts_[image]; }

  [[nodiscard]] std::size_t count() const { return radii_.size(); }
  [[nodiscard]] std::size_t entries() const; ///< of all lists together
  [[nodiscard]] std::size_t rebuilds() const { return rebuilds_; }
  [[nodiscard]] std::size_t repairs() const { return repairs_; } ///< spheres put in again one by one

private:
  [[nodiscard]] bool owns(std::size_t i, std::size_t j) const {
    return radii_[i] < radii_[j] || (radii_[i] == radii_[j] && i < j);
  }
  void set_box(const Vec<D>& size);
  void find_moved(std::span<const double> positions);
  bool repair_moved(std::span<const double> positions);
  template <class F>
  void for_each_near(std::size_t i, std::size_t l, F&& f) const;
  bool refill(std::size_t i);
  bool add_to_smaller(std::size_t j);
  [[nodiscard]] Eigen::Map<const Vec<D>> reference(std::size_t i) const {
    return Eigen::Map<const Vec<D>>(references_.data() + i * D);
  }

  std::array<bool, D> periodic_;
  std::vector<double> radii_;
  std::vector<double> reaches_; // radius with margin
  double skin_;
  double largest_reach_ = 0;

  SizeClassGrid<D> grid_;
  std::vector<float> drift_;       // bound on how far each reference has left its place in the grid
  std::vector<double> drifts_;     // its largest value in each level
  std::vector<double> references_; // where each sphere was put in, in the box of the last rebuild
  Vec<D> built_size_ = Vec<D>::Zero();
  Vec<D> size_ = Vec<D>::Zero();
  std::array<Vec<D>, 27> shifts_{};       // of the present box
  std::array<Vec<D>, 27> built_shifts_{}; // of the box of the last rebuild

  std::vector<Neighbour> list_;
  std::vector<std::uint32_t> begin_; // of each sphere's list; there is room up to the next one's
  std::vector<std::uint16_t> length_;
  std::vector<std::vector<std::uint32_t>> moved_; // by block of spheres
  std::size_t rebuilds_ = 0;
  std::size_t repairs_ = 0;
};

extern template class NeighbourList<2>;
extern template class NeighbourList<3>;

} // namespace tamp
