// Near list: for each sphere, everything that it could touch while all spheres move and grow a little.
#pragma once

#include "engine/base/vec.h"
#include "engine/search/contact_search.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tamp {

/// Spheres in a box, and who is near whom. A sphere may leave its listed place and radius by `budget` of that radius,
/// displacement and growth taken together; as long as all do, no pair outside the list can touch.
template <int D>
class NearList {
public:
  NearList(const SearchBox<D>& box, std::span<const double> positions, std::span<const double> radii, double budget)
      : box_(box), listed_(positions.begin(), positions.end()), listed_radii_(radii.begin(), radii.end()),
        budget_(budget), start_(radii.size() + 1, 0) {
    std::vector<double> grown(listed_radii_);
    for (double& radius : grown)
      radius *= 1 + budget;
    std::vector<Link> links;
    ContactSearch<D>(box, listed_, grown).for_each_pair(0, [&](const SpherePair<D>& pair) {
      const Vec<D> apart = pair.normal * (pair.gap + grown[pair.i] + grown[pair.j]);
      Vec<D> shift = Vec<D>::Zero(); // whole periods
      for (int a = 0; a < D; ++a) {
        if (box.periodic[static_cast<std::size_t>(a)])
          shift[a] = box.size[a] * std::round((apart[a] - (at(pair.j)[a] - at(pair.i)[a])) / box.size[a]);
      }
      links.push_back({pair.i, {static_cast<std::uint32_t>(pair.j), shift}});
      links.push_back({pair.j, {static_cast<std::uint32_t>(pair.i), -shift}});
    });
    for (const Link& link : links)
      ++start_[link.from + 1];
    for (std::size_t i = 0; i < radii.size(); ++i)
      start_[i + 1] += start_[i];
    near_.resize(links.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (const Link& link : links)
      near_[next[link.from]++] = link.to;
  }

  /// Largest radius that sphere i could have at p, the others being where they are now: its clearance.
  [[nodiscard]] double room(std::size_t i, const Vec<D>& p, std::span<const double> positions,
                            std::span<const double> radii) const {
    double room = std::numeric_limits<double>::infinity();
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      if (box_.periodic[n])
        continue;
      if (box_.wall[n][0])
        room = std::min(room, p[a]);
      if (box_.wall[n][1])
        room = std::min(room, box_.size[a] - p[a]);
    }
    for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
      const Near& near = near_[k];
      const Eigen::Map<const Vec<D>> other(positions.data() + near.sphere * D);
      // An image of itself moves along with it: each takes half the way.
      room = std::min(room,
                      near.sphere == i ? near.shift.norm() / 2 : (other + near.shift - p).norm() - radii[near.sphere]);
    }
    return room;
  }

  /// What sphere i at p may still grow to before the list would have to be renewed; below its radius: too far away.
  [[nodiscard]] double allowance(std::size_t i, const Vec<D>& p) const {
    return (1 + budget_) * listed_radii_[i] - (p - at(i)).norm();
  }

private:
  struct Near {
    std::uint32_t sphere = 0;
    Vec<D> shift = Vec<D>::Zero(); // to the image that is near
  };
  struct Link {
    std::size_t from;
    Near to;
  };

  [[nodiscard]] Eigen::Map<const Vec<D>> at(std::size_t i) const {
    return Eigen::Map<const Vec<D>>(listed_.data() + i * D);
  }

  SearchBox<D> box_;
  std::vector<double> listed_;
  std::vector<double> listed_radii_;
  double budget_;
  std::vector<std::size_t> start_;
  std::vector<Near> near_;
};

} // namespace tamp
