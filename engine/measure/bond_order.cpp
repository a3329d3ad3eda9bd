// Bond-orientational order: crystals, which equal spheres form at walls, tell themselves by it.
#include "engine/measure/metrics.h"
#include "engine/search/packing_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace tamp {

namespace {

/// Spheres whose gap is at most this share of the smaller radius are neighbours: half-way to the second shell of a
/// close packing, at √2 of the first. Of a body-centred lattice, whose second shell is at 2/√3, this takes in both
/// shells.
constexpr double kNeighbourGap = 2 * ((1 + std::numbers::sqrt2) / 2 - 1);

/// A bond joins two like surroundings if their order parameters have this scalar product; a sphere with so many such
/// bonds is in a crystal (ten Wolde, Ruiz-Montero & Frenkel, J. Chem. Phys. 104, 9932 (1996), with the stricter product
/// of Russo & Tanaka, Sci. Rep. 2, 505 (2012)).
constexpr double kLike = 0.7;
constexpr std::size_t kCrystalBonds = 7;

/// The numbers that six-fold order is made from: in 3D Y_6m of a direction for m = 0 to 6 (those of -m follow by
/// symmetry), in 2D e^{6iθ}.
template <int D>
struct Harmonics {
  static constexpr std::size_t count = D == 2 ? 1 : 7;
  std::array<std::complex<double>, count> of_m{};

  void operator+=(const Harmonics& other) {
    for (std::size_t m = 0; m < count; ++m)
      of_m[m] += other.of_m[m];
  }
  Harmonics& operator*=(double factor) {
    for (std::complex<double>& value : of_m)
      value *= factor;
    return *this;
  }
  /// Σ_m q_m q'_m* over all m from -6 to 6; real, as those of -m are conjugates up to a sign that both share.
  [[nodiscard]] double dot(const Harmonics& other) const {
    double sum = std::real(of_m[0] * std::conj(other.of_m[0]));
    for (std::size_t m = 1; m < count; ++m)
      sum += 2 * std::real(of_m[m] * std::conj(other.of_m[m]));
    return sum;
  }
};

Harmonics<2> harmonics(const Vec<2>& n) {
  const std::complex<double> once(n[0], n[1]);
  const std::complex<double> thrice = once * once * once;
  return {{thrice * thrice}};
}

Harmonics<3> harmonics(const Vec<3>& n) {
  constexpr double pi = std::numbers::pi;
  const double z = n[2];
  const double z2 = z * z;
  const std::array<double, 7> polar = {
      std::sqrt(13 / pi) / 32 * (((231 * z2 - 315) * z2 + 105) * z2 - 5),
      std::sqrt(273 / (2 * pi)) / 16 * z * ((33 * z2 - 30) * z2 + 5),
      std::sqrt(1365 / pi) / 64 * ((33 * z2 - 18) * z2 + 1),
      std::sqrt(1365 / pi) / 32 * z * (11 * z2 - 3),
      3 * std::sqrt(91 / (2 * pi)) / 32 * (11 * z2 - 1),
      3 * std::sqrt(1001 / pi) / 32 * z,
      std::sqrt(3003 / pi) / 64,
  };
  Harmonics<3> y;
  std::complex<double> around(1, 0); // (x + iy)^m
  for (std::size_t m = 0; m < polar.size(); ++m) {
    y.of_m[m] = polar[m] * around;
    around *= std::complex<double>(n[0], n[1]);
  }
  return y;
}

/// From Σ_m |q_m|² to the order parameter, 1 for a single bond.
template <int D>
double order(const Harmonics<D>& q) {
  constexpr double scale = D == 2 ? 1 : 4 * std::numbers::pi / 13;
  return std::sqrt(scale * q.dot(q));
}

template <int D>
std::vector<Measure> bond_order(const Packing& packing) {
  const std::size_t n = packing.count();
  struct Bond {
    std::uint32_t i, j;
  };
  std::vector<Bond> bonds;
  std::vector<Harmonics<D>> q(n);
  std::vector<std::size_t> neighbours(n, 0);
  Harmonics<D> all;
  // Opposite directions have the same harmonics of even degree, so a bond counts alike at both ends.
  search_of<D>(packing).for_each_pair(kNeighbourGap, [&](const SpherePair<D>& pair) {
    if (pair.normal.isZero()) // centres that coincide
      return;
    const Harmonics<D> y = harmonics(pair.normal);
    bonds.push_back({static_cast<std::uint32_t>(pair.i), static_cast<std::uint32_t>(pair.j)});
    for (const std::size_t end : {pair.i, pair.j}) {
      q[end] += y;
      ++neighbours[end];
    }
    all += y;
  });
  double sum = 0;
  std::size_t bound = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (neighbours[i] == 0)
      continue;
    q[i] *= 1 / static_cast<double>(neighbours[i]);
    sum += order<D>(q[i]);
    ++bound;
  }
  std::vector<std::size_t> like(n, 0);
  for (const Bond& bond : bonds) {
    const double product = q[bond.i].dot(q[bond.j]) / std::sqrt(q[bond.i].dot(q[bond.i]) * q[bond.j].dot(q[bond.j]));
    if (product > kLike) {
      ++like[bond.i];
      ++like[bond.j];
    }
  }
  const auto enough = D == 2 ? kCrystalBonds - 2 : kCrystalBonds; // of 6 neighbours in the plane 5
  const auto crystal = std::count_if(like.begin(), like.end(), [&](std::size_t count) { return count >= enough; });
  const auto total = static_cast<double>(n);
  if (!bonds.empty())
    all *= 1 / static_cast<double>(bonds.size());
  const std::string name = D == 2 ? "psi6" : "Q6";
  return {{name, order<D>(all), "1"},
          {name + "_local", bound == 0 ? 0 : sum / static_cast<double>(bound), "1"},
          {"crystalline", static_cast<double>(crystal) / total, "1"},
          {"neighbours", 2 * static_cast<double>(bonds.size()) / total, "1"}};
}

} // namespace

std::vector<Measure> measure_bond_order(const Metric&, const Packing& packing, const Scene&) {
  return with_dimension(packing.dimension, [&](auto d) { return bond_order<d>(packing); });
}

} // namespace tamp
