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
  built_size_ = box.size;
  bare_.resize(n);
  std::vector<double> inflated(n);
  parallel_for(n, [&](std::size_t i) {
    bare_[i] = radii[i] + hold[i];
    inflated[i] = bare_[i] + skin;
  });
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

/// A pair that is not listed was at least the sum of both spheres' b + skin apart, b being radius with hold. The box
/// has shrunk by λ, and each sphere is d from where that took it: the pair is at least λ (b + skin) − d for each of the
/// two apart, and does not touch while d ≤ λ (b + skin) − b.
template <int D>
bool CandidateList<D>::stale(const Vec<D>& size, std::span<const Vec<D>> centres) const {
  const std::size_t n = centres.size();
  if (n != built_at_.size())
    return true;
  const Vec<D> ratio = size.cwiseQuotient(built_size_);
  const double shrink = n > 0 ? ratio.minCoeff() : 1;
  struct Furthest {
    double from_start = 0;
    bool beyond = false;
    void operator+=(const Furthest& other) {
      from_start = std::max(from_start, other.from_start);
      beyond = beyond || other.beyond;
    }
  };
  struct Sum {
    Vec<D> moved = Vec<D>::Zero();
    void operator+=(const Vec<D>& v) { moved += v; }
    void operator+=(const Sum& other) { moved += other.moved; }
  };
  const auto moved_by = [&](std::size_t i) { return Vec<D>(centres[i] - ratio.cwiseProduct(built_at_[i])); };
  const Vec<D> common = parallel_sum<Sum>(n, moved_by).moved / static_cast<double>(std::max<std::size_t>(n, 1));
  const auto furthest = parallel_sum<Furthest>(n, [&](std::size_t i) {
    const Vec<D> moved = moved_by(i);
    const double allowed = shrink * (bare_[i] + skin_) - bare_[i];
    return Furthest{moved.squaredNorm(), !(allowed > 0 && (moved - common).squaredNorm() <= allowed * allowed)};
  });
  // Pairs part by what their spheres move apart from the common way; walls have two skins for the whole way of one.
  return furthest.beyond || (has_wall_ && furthest.from_start > 4 * skin_ * skin_);
}

template class CandidateList<2>;
template class CandidateList<3>;

} // namespace tamp
