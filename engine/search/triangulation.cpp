// Regular triangulations through CGAL.
#include "engine/search/triangulation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <utility>

namespace tamp {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Index = std::uint32_t;
using Edges = std::vector<std::pair<Index, Index>>;

using Vertex2 =
    CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel, CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
using Structure2 = CGAL::Triangulation_data_structure_2<Vertex2, CGAL::Regular_triangulation_face_base_2<Kernel>>;
using Triangulation2 = CGAL::Regular_triangulation_2<Kernel, Structure2>;

using Vertex3 =
    CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Structure3 = CGAL::Triangulation_data_structure_3<Vertex3, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation3 = CGAL::Regular_triangulation_3<Kernel, Structure3>;

template <class Triangulation, class MakePoint>
Triangulation triangulate(std::span<const double> radii, const MakePoint& centre) {
  std::vector<std::pair<typename Triangulation::Weighted_point, Index>> points;
  points.reserve(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i)
    points.emplace_back(typename Triangulation::Weighted_point(centre(i), radii[i] * radii[i]), static_cast<Index>(i));
  return Triangulation(points.begin(), points.end());
}

Edges edges_2d(std::span<const double> x, std::span<const double> radii) {
  const auto t =
      triangulate<Triangulation2>(radii, [&](std::size_t i) { return Kernel::Point_2(x[2 * i], x[2 * i + 1]); });
  Edges edges;
  for (const auto& [face, i] : t.finite_edges())
    edges.emplace_back(face->vertex(t.cw(i))->info(), face->vertex(t.ccw(i))->info());
  return edges;
}

Edges edges_3d(std::span<const double> x, std::span<const double> radii) {
  const auto t = triangulate<Triangulation3>(
      radii, [&](std::size_t i) { return Kernel::Point_3(x[3 * i], x[3 * i + 1], x[3 * i + 2]); });
  Edges edges;
  for (const auto& edge : t.finite_edges())
    edges.emplace_back(edge.first->vertex(edge.second)->info(), edge.first->vertex(edge.third)->info());
  return edges;
}

} // namespace

template <int D>
Adjacency power_neighbours(std::span<const double> positions, std::span<const double> radii) {
  const Edges edges = D == 2 ? edges_2d(positions, radii) : edges_3d(positions, radii);
  Adjacency out;
  out.start.assign(radii.size() + 1, 0);
  for (const auto& [i, j] : edges) {
    ++out.start[i + 1];
    ++out.start[j + 1];
  }
  for (std::size_t i = 0; i < radii.size(); ++i)
    out.start[i + 1] += out.start[i];
  std::vector<std::size_t> next(out.start.begin(), out.start.end() - 1);
  out.index.resize(2 * edges.size());
  for (const auto& [i, j] : edges) {
    out.index[next[i]++] = j;
    out.index[next[j]++] = i;
  }
  for (std::size_t i = 0; i < radii.size(); ++i) // CGAL keeps its cells in an order of its own
    std::sort(out.index.begin() + static_cast<std::ptrdiff_t>(out.start[i]),
              out.index.begin() + static_cast<std::ptrdiff_t>(out.start[i + 1]));
  return out;
}

template Adjacency power_neighbours<2>(std::span<const double>, std::span<const double>);
template Adjacency power_neighbours<3>(std::span<const double>, std::span<const double>);

} // namespace tamp
