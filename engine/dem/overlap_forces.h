// The frictionless overlap energy of spheres: forces, virial and stiffness in one loop over a neighbour list.
#pragma once

#include "engine/base/parallel.h"
#include "engine/contact/hertz.h"
#include "engine/contact/material.h"
#include "engine/search/neighbour_list.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tamp {

/// What an elastic contact answers with.
struct Repulsion {
  double force;
  double stiffness; ///< dF/dδ
  double energy;
};

/// Harmonic repulsion with modulus 1: E = k δ²/2, k = r^(D−2), r the smaller radius. Then a pressure p gives relative
/// overlaps δ/r of the order of p whatever the sizes: the force p r^(D−1) of a contact over k r is p.
template <int D>
struct Harmonic {
  [[nodiscard]] static double stiffness(double smaller_radius) { return D == 3 ? smaller_radius : 1.0; }
  [[nodiscard]] static Repulsion at(double overlap, double smaller_radius, double /*larger_radius*/) {
    const double k = stiffness(smaller_radius);
    return {k * overlap, k, 0.5 * k * overlap * overlap};
  }
};

/// Hertz's contact, F ∝ δ^{3/2}, of two spheres or of a sphere and a wall.
struct HertzRepulsion {
  Hertz law{};
  [[nodiscard]] Repulsion at(double overlap, double smaller_radius, double larger_radius) const {
    return at(overlap, effective(smaller_radius, larger_radius));
  }
  [[nodiscard]] Repulsion at(double overlap, double effective_radius) const {
    const NormalForce contact = law.at(overlap, effective_radius);
    return {contact.force, 2 * law.modulus * contact.contact_radius, 0.4 * contact.force * overlap};
  }
};

/// Sums over all contacts.
struct ContactSums {
  double energy = 0;
  double virial = 0;   ///< Σ f·d, d the distance of the centres: D times pressure times volume
  double stretch = 0;  ///< Σ k d²: second derivative of the energy for an affine change of the box's logarithm
  double force = 0;    ///< Σ f
  double contacts = 0; ///< their number
  double deepest = 0;  ///< largest δ/r
  void operator+=(const ContactSums& other) {
    energy += other.energy;
    virial += other.virial;
    stretch += other.stretch;
    force += other.force;
    contacts += other.contacts;
    deepest = std::max(deepest, other.deepest);
  }
};

/// Evaluates forces block by block. A block adds to its own spheres at once and keeps what it owes to others; debts are
/// paid in the order of the blocks. So every sum has one order, on any number of threads.
template <int D, class Law = Harmonic<D>>
class OverlapForces {
public:
  /// Spheres of a block; fixed, as the blocks decide the order of sums.
  static constexpr std::size_t kBlock = 2048;

  /// Sets the forces (D numbers a sphere) and, if `stiffness` is not empty, Σ k over the contacts of each sphere.
  ContactSums evaluate(const NeighbourList<D>& list, std::span<const double> positions, std::span<const double> radii,
                       std::span<double> forces, std::span<double> stiffness, const Law& law = {}) {
    return stiffness.empty() ? run<false>(list, positions, radii, forces, stiffness, law)
                             : run<true>(list, positions, radii, forces, stiffness, law);
  }

private:
  struct Debt {
    std::uint32_t sphere;
    double k;
    Vec<D> force;
  };

  template <bool with_stiffness>
  ContactSums run(const NeighbourList<D>& list, std::span<const double> positions, std::span<const double> radii,
                  std::span<double> forces, std::span<double> stiffness, const Law& law) {
    const std::size_t n = radii.size();
    const std::size_t blocks = (n + kBlock - 1) / kBlock;
    debts_.resize(blocks);
    sums_.resize(blocks);
    parallel_tasks(blocks, [&](std::size_t b) {
      const std::size_t begin = b * kBlock;
      const std::size_t end = std::min(n, begin + kBlock);
      std::fill(forces.begin() + static_cast<std::ptrdiff_t>(begin * D),
                forces.begin() + static_cast<std::ptrdiff_t>(end * D), 0.0);
      if constexpr (with_stiffness)
        std::fill(stiffness.begin() + static_cast<std::ptrdiff_t>(begin),
                  stiffness.begin() + static_cast<std::ptrdiff_t>(end), 0.0);
      std::vector<Debt>& debts = debts_[b];
      debts.clear();
      ContactSums sums;
      for (std::size_t i = begin; i < end; ++i) {
        const Vec<D> x = Eigen::Map<const Vec<D>>(positions.data() + i * D);
        const double r = radii[i];
        Vec<D> on_i = Vec<D>::Zero();
        double k_i = 0;
        for (const Neighbour neighbour : list.of(i)) {
          const std::size_t j = neighbour.index();
          const Vec<D> across = Eigen::Map<const Vec<D>>(positions.data() + j * D) + list.shift(neighbour.image()) - x;
          const double touching = r + radii[j];
          const double squared = across.squaredNorm();
          if (squared >= touching * touching)
            continue;
          const double distance = std::sqrt(squared);
          const double overlap = touching - distance;
          const auto [f, k, energy] = law.at(overlap, r, radii[j]);
          // Spheres whose centres coincide part along the first axis.
          const Vec<D> load = distance > 0 ? Vec<D>(f / distance * across) : Vec<D>(f * Vec<D>::Unit(0));
          on_i -= load;
          sums.energy += energy;
          sums.virial += f * distance;
          sums.stretch += k * squared;
          sums.force += f;
          sums.contacts += 1;
          sums.deepest = std::max(sums.deepest, overlap / r);
          if constexpr (with_stiffness)
            k_i += k;
          if (j >= begin && j < end) {
            Eigen::Map<Vec<D>>(forces.data() + j * D) += load;
            if constexpr (with_stiffness)
              stiffness[j] += k;
          } else {
            debts.push_back({static_cast<std::uint32_t>(j), k, load});
          }
        }
        Eigen::Map<Vec<D>>(forces.data() + i * D) += on_i;
        if constexpr (with_stiffness)
          stiffness[i] += k_i;
      }
      sums_[b] = sums;
    });
    ContactSums total;
    for (std::size_t b = 0; b < blocks; ++b) {
      total += sums_[b];
      for (const Debt& debt : debts_[b]) {
        Eigen::Map<Vec<D>>(forces.data() + std::size_t{debt.sphere} * D) += debt.force;
        if constexpr (with_stiffness)
          stiffness[debt.sphere] += debt.k;
      }
    }
    return total;
  }

  std::vector<std::vector<Debt>> debts_; // of each block
  std::vector<ContactSums> sums_;
};

} // namespace tamp
