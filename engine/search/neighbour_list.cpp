// When a neighbour list is complete, and how it is brought up to date.
//
// Let L be the box of the last rebuild and λ L the present one (λ the smallest ratio of edges). A pair that is not
// listed had, in L, a distance above R_i + R_j with R = r (1 + skin). Now it is at least λ (R_i + R_j) − d_i − d_j, d
// being how far a sphere is from its shrunken reference. So no pair overlaps while d_i ≤ λ R_i − r_i for every sphere.
#include "engine/search/neighbour_list.h"

#include "engine/base/error.h"
#include "engine/base/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

constexpr std::size_t kBlock = 1024;

/// Free places of a list after a rebuild, for what repairs add.
constexpr std::uint32_t kSpare = 2;

/// Share of the spheres up to which repairs are cheaper than a rebuild: a repair searches around one sphere for larger
/// and for smaller ones, and touches a dozen lists.
constexpr double kRepairShare = 0.03;

/// Share of the skin that shrinking of the box may use up before a rebuild; the rest is for the spheres' own motion.
constexpr double kShrinkShare = 0.5;

/// Largest drift of a reference from its place in the grid, in units of its level's largest reach.
constexpr double kMostDrift = 1;

/// Keeps sums of drifts in single precision bounds.
constexpr double kRoundUp = 1.00001;

/// Calls f(block, begin, end) for blocks of fixed size.
template <class F>
void for_blocks(std::size_t n, F&& f) {
  parallel_tasks((n + kBlock - 1) / kBlock, [&](std::size_t b) { f(b, b * kBlock, std::min(n, (b + 1) * kBlock)); });
}

} // namespace

template <int D>
NeighbourList<D>::NeighbourList(const std::array<bool, D>& periodic, std::span<const double> radii, double skin)
    : periodic_(periodic), radii_(radii.begin(), radii.end()), reaches_(radii_), skin_(skin) {
  if (radii.size() > Neighbour::kMostSpheres)
    throw Error(
        fmt::format("a neighbour list holds at most {} spheres, not {}", Neighbour::kMostSpheres, radii.size()));
  for (double& reach : reaches_) {
    reach *= 1 + skin;
    largest_reach_ = std::max(largest_reach_, reach);
  }
}

template <int D>
void NeighbourList<D>::set_box(const Vec<D>& size) {
  size_ = size;
  for (int a = 0; a < D; ++a) {
    if (periodic_[static_cast<std::size_t>(a)] && !(2 * largest_reach_ < size[a]))
      throw Error(fmt::format("the periodic box of edge {} is too small for a sphere with its margin (diameter {})",
                              size[a], 2 * largest_reach_));
  }
  for (std::uint32_t image = 0; image < 27; ++image) {
    std::uint32_t digits = image;
    for (int a = D - 1; a >= 0; --a) {
      shifts_[image][a] = (static_cast<double>(digits % 3) - 1) * size[a];
      digits /= 3;
    }
  }
}

template <int D>
ListUpdate NeighbourList<D>::update(const Vec<D>& size, std::span<double> positions) {
  set_box(size);
  const double shrink = (size.array() / built_size_.array()).minCoeff();
  if (rebuilds_ == 0 || !(1 - shrink < kShrinkShare * skin_ / (1 + skin_))) {
    rebuild(size, positions);
    return ListUpdate::rebuilt;
  }
  find_moved(positions);
  std::size_t moved = 0;
  for (const auto& block : moved_)
    moved += block.size();
  if (moved == 0)
    return ListUpdate::none;
  if (static_cast<double>(moved) > kRepairShare * static_cast<double>(count()) || !repair_moved(positions)) {
    rebuild(size, positions);
    return ListUpdate::rebuilt;
  }
  return ListUpdate::repaired;
}

template <int D>
std::size_t NeighbourList<D>::entries() const {
  std::size_t sum = 0;
  for (const std::uint16_t length : length_)
    sum += length;
  return sum;
}

/// Collects the spheres that have left their margins.
template <int D>
void NeighbourList<D>::find_moved(std::span<const double> positions) {
  const Vec<D> ratio = size_.cwiseQuotient(built_size_);
  const double shrink = ratio.minCoeff();
  moved_.resize((count() + kBlock - 1) / kBlock);
  for_blocks(count(), [&](std::size_t b, std::size_t begin, std::size_t end) {
    moved_[b].clear();
    for (std::size_t i = begin; i < end; ++i) {
      const Vec<D> moved = Eigen::Map<const Vec<D>>(positions.data() + i * D) - ratio.cwiseProduct(reference(i));
      const double allowed = shrink * reaches_[i] - radii_[i];
      if (!(moved.squaredNorm() <= allowed * allowed))
        moved_[b].push_back(static_cast<std::uint32_t>(i));
    }
  });
}

template <int D>
void NeighbourList<D>::rebuild(const Vec<D>& size, std::span<double> positions) {
  set_box(size);
  const std::size_t n = count();
  for (std::size_t a = 0; a < D; ++a) {
    const double edge = size[static_cast<int>(a)];
    for (std::size_t i = 0; periodic_[a] && i < n; ++i) {
      double& x = positions[i * D + a];
      x -= edge * std::floor(x / edge);
      if (!(x < edge)) // a tiny negative number rounds up to the edge
        x = 0;
    }
  }
  references_.assign(positions.begin(), positions.end());
  built_size_ = size;
  grid_.build(size, periodic_, references_, reaches_);
  built_shifts_ = shifts_;
  drifts_.assign(grid_.levels().size(), 0);
  drift_.assign(n, 0);

  const std::size_t blocks = (n + kBlock - 1) / kBlock;
  std::vector<std::vector<Neighbour>> found(blocks);
  begin_.assign(n + 1, 0);
  length_.assign(n, 0);
  for_blocks(n, [&](std::size_t b, std::size_t begin, std::size_t end) {
    found[b].reserve(16 * (end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t before = found[b].size();
      const Vec<D> x = reference(i);
      const double reach = reaches_[i];
      for (std::size_t l = 0; l <= grid_.level_of(i); ++l) {
        const auto& level = grid_.levels()[l];
        level.visit(x, reach + level.largest, [&](const auto& entry, std::uint32_t image) {
          const Vec<D> across = entry.centre + shifts_[image] - x;
          const double touching = reach + entry.reach;
          if (across.squaredNorm() <= touching * touching && owns(i, entry.index))
            found[b].emplace_back(entry.index, image);
        });
      }
      length_[i] = static_cast<std::uint16_t>(found[b].size() - before);
    }
  });
  for (std::size_t i = 0; i < n; ++i)
    begin_[i + 1] = begin_[i] + length_[i] + kSpare;
  list_.resize(begin_[n]);
  for_blocks(n, [&](std::size_t b, std::size_t begin, std::size_t end) {
    auto next = found[b].begin();
    for (std::size_t i = begin; i < end; ++i) {
      std::copy_n(next, length_[i], list_.begin() + begin_[i]);
      next += length_[i];
    }
  });
  ++rebuilds_;
}

/// Calls f(k, image) for the spheres of level l that i's enlarged sphere overlaps, references against references.
template <int D>
template <class F>
void NeighbourList<D>::for_each_near(std::size_t i, std::size_t l, F&& f) const {
  const auto& level = grid_.levels()[l];
  const Vec<D> x = reference(i);
  level.visit(x, reaches_[i] + level.largest + drifts_[l], [&](const auto& entry, std::uint32_t image) {
    const Vec<D> across = reference(entry.index) + built_shifts_[image] - x;
    const double touching = reaches_[i] + entry.reach;
    if (across.squaredNorm() <= touching * touching)
      f(entry.index, image);
  });
}

/// Puts the moved spheres in anew; false if that is not possible and only a rebuild helps.
template <int D>
bool NeighbourList<D>::repair_moved(std::span<const double> positions) {
  const Vec<D> back = built_size_.cwiseQuotient(size_);
  for (const auto& block : moved_) {
    for (const std::uint32_t j : block) {
      const Vec<D> place = Eigen::Map<const Vec<D>>(positions.data() + std::size_t{j} * D).cwiseProduct(back);
      const std::size_t l = grid_.level_of(j);
      drift_[j] += static_cast<float>((place - reference(j)).norm() * kRoundUp);
      drifts_[l] = std::max(drifts_[l], double{drift_[j]});
      if (!(drifts_[l] <= kMostDrift * grid_.levels()[l].largest))
        return false;
      Eigen::Map<Vec<D>>(references_.data() + std::size_t{j} * D) = place;
    }
  }
  // The search through cells reaches one period: two largest spheres and what both have drifted must fit in.
  const double drift = *std::max_element(drifts_.begin(), drifts_.end());
  for (int a = 0; a < D; ++a) {
    if (periodic_[static_cast<std::size_t>(a)] && !(2 * (largest_reach_ + drift) < built_size_[a]))
      return false;
  }
  for (const auto& block : moved_) {
    for (const std::uint32_t j : block) {
      if (!refill(j) || !add_to_smaller(j))
        return false;
      ++repairs_;
    }
  }
  return true;
}

/// Searches the larger neighbours of i anew; false if they do not fit into the list's room.
template <int D>
bool NeighbourList<D>::refill(std::size_t i) {
  const std::size_t room = begin_[i + 1] - begin_[i];
  std::size_t length = 0;
  for (std::size_t l = 0; l <= grid_.level_of(i); ++l) {
    for_each_near(i, l, [&](std::uint32_t j, std::uint32_t image) {
      if (!owns(i, j))
        return;
      if (length < room)
        list_[begin_[i] + length] = {j, image};
      ++length;
    });
  }
  length_[i] = static_cast<std::uint16_t>(std::min(length, room));
  return length <= room;
}

/// Adds j to the lists of the smaller spheres around it. Entries that j has left behind do no harm.
template <int D>
bool NeighbourList<D>::add_to_smaller(std::size_t j) {
  bool fits = true;
  for (std::size_t l = grid_.level_of(j); l < grid_.levels().size(); ++l) {
    for_each_near(j, l, [&](std::uint32_t i, std::uint32_t image) {
      if (!owns(i, j))
        return;
      // Seen from i, j's image lies the opposite way: each digit 0, 1, 2 becomes 2, 1, 0.
      const Neighbour entry(static_cast<std::uint32_t>(j), 2 * kHomeImage<D> - image);
      Neighbour* first = list_.data() + begin_[i];
      Neighbour* last = first + length_[i];
      if (std::find(first, last, entry) != last)
        return;
      if (begin_[i] + length_[i] < begin_[i + 1])
        list_[begin_[i] + length_[i]++] = entry;
      else
        fits = refill(i) && fits;
    });
  }
  return fits;
}

template class NeighbourList<2>;
template class NeighbourList<3>;

} // namespace tamp
