// Barycentres: the middle of each sphere's neighbours in the power diagram, walls and periodic faces included.
#pragma once

#include "engine/base/vec.h"
#include "engine/search/contact_search.h"
#include "engine/search/triangulation.h"

#include <cstddef>
#include <span>
#include <vector>

namespace tamp {

/// How near a face, in its own radii, a sphere must be to have an image beyond it.
inline constexpr double kImageReach = 3;

/// The mean of the centres of each sphere's neighbours; its own centre if it has none. Spheres near a wall are mirrored
/// in it, and those near a periodic face repeated beyond the opposite one, so that a face is a neighbour too and does
/// not drive everything away from it. Images only steer: what may be touched is not decided here.
template <int D>
std::vector<Vec<D>> neighbour_barycentres(const SearchBox<D>& box, std::span<const double> positions,
                                          std::span<const double> radii) {
  std::vector<double> x(positions.begin(), positions.end());
  std::vector<double> r(radii.begin(), radii.end());
  for (int a = 0; a < D; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const std::size_t count = r.size(); // images of images too: across edges and corners
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::size_t side : {0U, 1U}) {
        const double face = side == 0 ? 0 : box.size[a];
        const double here = x[i * D + n];
        if (std::abs(here - face) > kImageReach * r[i] || !(box.periodic[n] || box.wall[n][side]))
          continue;
        for (std::size_t b = 0; b < D; ++b)
          x.push_back(x[i * D + b]);
        const double beyond = side == 0 ? here + box.size[a] : here - box.size[a];
        x[x.size() - D + n] = box.periodic[n] ? beyond : 2 * face - here;
        r.push_back(r[i]);
      }
    }
  }
  const Adjacency neighbours = power_neighbours<D>(x, r);
  std::vector<Vec<D>> out(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    Vec<D> sum = Vec<D>::Zero();
    for (const std::uint32_t j : neighbours.of(i))
      sum += Eigen::Map<const Vec<D>>(x.data() + j * D);
    const auto count = static_cast<double>(neighbours.of(i).size());
    out[i] = count > 0 ? Vec<D>(sum / count) : Vec<D>(Eigen::Map<const Vec<D>>(positions.data() + i * D));
  }
  return out;
}

} // namespace tamp
