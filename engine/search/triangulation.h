// Neighbours in the power (Laguerre) diagram of spheres: who shares a face of cells with whom.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tamp {

/// The neighbours of each sphere: those of sphere i are index[start[i]] … index[start[i + 1] − 1], in increasing order.
struct Adjacency {
  std::vector<std::size_t> start;
  std::vector<std::uint32_t> index;

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const {
    return {index.data() + start[i], start[i + 1] - start[i]};
  }
};

/// The edges of the regular triangulation (dual of the power diagram) of spheres with the weights radius²; for equal
/// radii that is the Delaunay triangulation. Exact predicates (CGAL); cospherical points are triangulated in a way that
/// depends on the input alone. Spheres without a cell of their own (inside others) have no neighbours.
/// positions: D numbers a sphere, finite; radii: above 0.
template <int D>
Adjacency power_neighbours(std::span<const double> positions, std::span<const double> radii);

} // namespace tamp
