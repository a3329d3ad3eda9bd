// Sweeps of moving and enlarging over a packing.
#include "engine/generate/moving_enlarging/moving_enlarging.h"

#include "engine/generate/moving_enlarging/barycentre.h"
#include "engine/generate/moving_enlarging/near_list.h"
#include "engine/model/size_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tamp {

namespace {

/// What a sphere may move and grow in one sweep, as a share of its radius. Measured on the lognormal powder: 1 gains
/// twice as much per sweep as 0.3; with 2 the lists of neighbours cost more than is gained.
constexpr double kBudget = 1;

/// Rounds over all spheres with one triangulation and one list of neighbours. Measured: the second and third give a
/// sweep a third more for a tenth of its time, further ones next to nothing.
constexpr int kRounds = 3;

/// Halvings of the step towards the barycentre.
constexpr int kHalvings = 7;

/// Share of its radius that a sphere stays away from what stops its growth, so that rounding cannot make it overlap.
constexpr double kApart = 1e-13;

template <int D>
class Bed {
public:
  Bed(Packing packing, double largest) : packing_(std::move(packing)), largest_(largest) {
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      box_.size[a] = packing_.size[n];
      box_.periodic[n] = packing_.boundary[n] == Boundary::periodic;
      box_.wall[n] = {packing_.boundary[n] != Boundary::periodic, packing_.boundary[n] == Boundary::wall};
    }
  }

  void sweep() {
    const auto targets = neighbour_barycentres<D>(box_, packing_.positions, packing_.radii);
    const NearList<D> near(box_, packing_.positions, packing_.radii, kBudget);
    for (int round = 0; round < kRounds; ++round) {
      for (std::size_t i = 0; i < packing_.count(); ++i)
        move_and_grow(i, targets[i], near);
    }
    for (std::size_t i = 0; i < packing_.count(); ++i)
      wrap(i);
  }

  /// Volume of all spheres (in 2D: area) over that of the box.
  [[nodiscard]] double solid_share() const {
    double share = 0;
    for (const double radius : packing_.radii)
      share += std::pow(radius, D) * (D == 2 ? M_PI : 4 * M_PI / 3);
    return share / box_.size.prod();
  }

  [[nodiscard]] Packing& packing() { return packing_; }

private:
  void move_and_grow(std::size_t i, const Vec<D>& target, const NearList<D>& near) {
    Eigen::Map<Vec<D>> centre(packing_.positions.data() + i * D);
    double& radius = packing_.radii[i];
    const auto room_at = [&](const Vec<D>& p) {
      return std::min(near.room(i, p, packing_.positions, packing_.radii), near.allowance(i, p));
    };
    const Vec<D> way = target - centre;
    const double length = way.norm();
    Vec<D> best = centre;
    double room = room_at(best);
    double step = length > kBudget * radius ? kBudget * radius / length : 1.0;
    for (int halving = 0; halving <= kHalvings && length > 0; ++halving, step /= 2) {
      const Vec<D> p = centre + step * way;
      // Room for more than its radius there means that the straight way there was not needed: nothing is overlapped.
      if (const double there = room_at(p); there > std::max(room, radius)) {
        best = p;
        room = there;
      }
    }
    centre = best;
    radius = std::max(radius, std::min(room * (1 - kApart), largest_));
  }

  void wrap(std::size_t i) {
    for (std::size_t a = 0; a < D; ++a) {
      double& x = packing_.positions[i * D + a];
      const double edge = packing_.size[a];
      if (box_.periodic[a])
        x -= std::floor(x / edge) * edge;
    }
  }

  Packing packing_;
  double largest_;
  SearchBox<D> box_;
};

} // namespace

Generated generate_moving_enlarging(const Request& request) {
  return with_dimension(request.job.scene.dimension, [&](auto d) {
    Generated out;
    const SizeLaw law(request.job.scene.psd, d);
    if (!law.classes().empty()) {
      out.outcome = Outcome::not_applicable;
      out.reason = "moving-enlarging lets every sphere grow by another amount; a law of exact sizes would be lost";
      return out;
    }
    Bed<d> bed(*request.parent, law.largest());
    const double before = bed.solid_share();
    const std::int64_t sweeps = request.job.method.moving_enlarging.sweeps;
    for (std::int64_t i = 0; i < sweeps; ++i)
      bed.sweep();
    double largest_growth = 1;
    for (std::size_t i = 0; i < bed.packing().count(); ++i)
      largest_growth = std::max(largest_growth, bed.packing().radii[i] / request.parent->radii[i]);
    out.measures = {{"N", static_cast<double>(bed.packing().count()), "1"},
                    {"sweeps", static_cast<double>(sweeps), "1"},
                    {"phi_box_gain", bed.solid_share() - before, "1"},
                    {"largest_growth", largest_growth, "1"}};
    out.packing = std::move(bed.packing());
    return out;
  });
}

} // namespace tamp
