// Filling the list of near pairs from the contact search, by inflating every sphere by its margin.
#include "engine/dem/near_list.h"

#include "engine/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace tamp {

template <int D>
void CandidateList<D>::build(const SearchBox<D>& box, std::span<const Vec<D>> centres, std::span<const double> radii,
                             std::span<const double> hold, double skin) {
  const std::size_t n = radii.size();
  skin_ = skin;
  built_at_.assign(centres.begin(), centres.end());
  std::vector<double> inflated(n);
  parallel_for(n, [&](std::size_t i) { inflated[i] = radii[i] + hold[i] + skin; });
  pairs_.clear();
  walls_.clear();
  has_wall_ = false;
  if (n == 0)
    return;

  const ContactSearch<D> search(box, std::span(centres[0].data(), n * D), inflated);
  search.for_each_pair(0, [&](const SpherePair<D>& found) {
    if (found.i == found.j)
      return;
    const auto i = std::min(found.i, found.j);
    const auto j = std::max(found.i, found.j);
    // The vector from i to the image of j, without what the centres themselves lie apart, is whole periods.
    const double distance = found.gap + inflated[i] + inflated[j];
    const Vec<D> apart = (found.i < found.j ? distance : -distance) * found.normal;
    const Vec<D> periods = (apart - (centres[j] - centres[i])).cwiseQuotient(box.size);
    NearPair<D> pair{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), {}};
    for (int a = 0; a < D; ++a) {
      if (box.periodic[static_cast<std::size_t>(a)])
        pair.image[static_cast<std::size_t>(a)] = static_cast<std::int8_t>(std::lround(periods[a]));
    }
    pairs_.push_back(pair);
  });
  std::sort(pairs_.begin(), pairs_.end());

  for (int axis = 0; axis < D; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for (std::size_t side = 0; side < 2; ++side) {
      if (box.periodic[a] || !box.wall[a][side])
        continue;
      has_wall_ = true;
      for (std::size_t i = 0; i < n; ++i) {
        const double height = side == 0 ? centres[i][axis] : box.size[axis] - centres[i][axis];
        if (height <= inflated[i] + skin) // a wall's contact holds as long as a pair's two margins
          walls_.push_back(
              {static_cast<std::uint32_t>(i), static_cast<std::uint8_t>(axis), static_cast<std::uint8_t>(side)});
      }
    }
  }
  std::sort(walls_.begin(), walls_.end());
}

template <int D>
bool CandidateList<D>::stale(std::span<const Vec<D>> centres) const {
  const std::size_t n = centres.size();
  if (n != built_at_.size())
    return true;
  struct Furthest {
    double from_start = 0;
    double from_common = 0;
    void operator+=(const Furthest& other) {
      from_start = std::max(from_start, other.from_start);
      from_common = std::max(from_common, other.from_common);
    }
  };
  struct Sum {
    Vec<D> moved = Vec<D>::Zero();
    void operator+=(const Vec<D>& v) { moved += v; }
    void operator+=(const Sum& other) { moved += other.moved; }
  };
  const Vec<D> common = parallel_sum<Sum>(n, [&](std::size_t i) { return Vec<D>(centres[i] - built_at_[i]); }).moved /
                        static_cast<double>(std::max<std::size_t>(n, 1));
  const auto furthest = parallel_sum<Furthest>(n, [&](std::size_t i) {
    const Vec<D> moved = centres[i] - built_at_[i];
    return Furthest{moved.squaredNorm(), (moved - common).squaredNorm()};
  });
  // Pairs part by what their spheres move apart from the common way; walls have two skins for the whole way of one.
  return furthest.from_common > skin_ * skin_ || (has_wall_ && furthest.from_start > 4 * skin_ * skin_);
}

template class CandidateList<2>;
template class CandidateList<3>;

} // namespace tamp
