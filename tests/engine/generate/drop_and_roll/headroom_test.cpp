// What headroom excludes fits nowhere, and what fits nowhere it comes to exclude.
#include "engine/base/random.h"
#include "engine/generate/drop_and_roll/descent.h"
#include "engine/generate/drop_and_roll/headroom.h"
#include "engine/generate/generator.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <string>

using namespace tamp;
using namespace tamp::test;

namespace {

/// A drop-and-roll bed, rebuilt sphere by sphere up to a share of its spheres.
template <int D>
struct Bed {
  Packing packing;
  Vec<D> size;
  std::array<bool, D> periodic{};
  std::vector<Vec<D>> centres;

  Bed(bool is_periodic, std::uint64_t seed) {
    Job job;
    job.scene.dimension = D;
    job.scene.size = {D == 2 ? 30.0 : 12.0};
    job.scene.sides = is_periodic ? Sides::periodic : Sides::walls;
    job.scene.psd = lognormal_psd(0, 0.5, 0.3, 4);
    job.scene = completed(job.scene);
    packing = generate({job, "bed " + std::to_string(seed)}).packing;
    size.setConstant(packing.size[0]);
    for (int a = 0; a < D - 1; ++a)
      periodic[static_cast<std::size_t>(a)] = is_periodic;
    for (std::size_t i = 0; i < packing.count(); ++i)
      centres.emplace_back(Eigen::Map<const Vec<D>>(&packing.positions[i * D]));
  }

  /// The radius of the largest sphere that touches the lid above x, by a look at everything.
  [[nodiscard]] double largest_at(const Vec<D>& x, std::size_t count) const {
    double h = size[vertical<D>] / 2;
    for (int a = 0; a < D - 1; ++a) {
      if (!periodic[static_cast<std::size_t>(a)])
        h = std::min({h, x[a], size[a] - x[a]});
    }
    for (std::size_t i = 0; i < count; ++i) {
      double s2 = 0;
      for (int a = 0; a < D - 1; ++a) {
        const double s = std::abs(centres[i][a] - x[a]);
        const double nearest = periodic[static_cast<std::size_t>(a)] ? std::min(s, size[a] - s) : s;
        s2 += nearest * nearest;
      }
      const double d = size[vertical<D>] - centres[i][vertical<D>];
      const double r = packing.radii[i];
      h = std::min(h, (s2 + d * d - r * r) / (2 * (r + d))); // |centre − (x, lid − h)| = r + h
    }
    return h;
  }

  static constexpr int steps = D == 2 ? 3000 : 120;

  /// The largest of largest_at over a fine lattice of the plan: just below the true maximum.
  [[nodiscard]] double largest(std::size_t count) const {
    double best = 0;
    Vec<D> x = Vec<D>::Zero();
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; j < (D == 2 ? 1 : steps); ++j) {
        x[0] = (i + 0.5) / steps * size[0];
        x[D - 2] = D == 2 ? x[0] : (j + 0.5) / steps * size[D - 2];
        best = std::max(best, largest_at(x, count));
      }
    }
    return best;
  }
};

template <int D>
void excludes_what_fits_nowhere(bool is_periodic) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Bed<D> bed(is_periodic, seed);
    const std::vector<SizeClass> classes = {{4.0, 20.0}, {1.0, 200.0}};
    HierarchicalGrid<D> grid(bed.size, bed.periodic, classes);
    Headroom<D> headroom(bed.size, bed.periodic, grid);
    RandomStream random("radii", seed);
    const std::size_t count = bed.centres.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 7 == 0) // asked all the time, as a run does
        headroom.excludes(0.3 + 3 * random.uniform());
      if (i % (count / 4) == 0 || i + 1 == count) {
        const double largest = bed.largest(i);
        INFO(D << "D, seed " << seed << ", spheres " << i << ", largest " << largest);
        CHECK_FALSE(headroom.excludes(largest));
        CHECK_FALSE(headroom.excludes(0.99 * largest));
        const double more = largest + bed.size[0] / bed.steps; // the points may miss the maximum by about their spacing
        int questions = 0;
        while (!headroom.excludes(more) && questions < 2000)
          ++questions;
        CHECK(questions < 2000);
        CHECK(headroom.excludes(1.01 * more));
      }
      grid.insert(bed.centres[i], bed.packing.radii[i]);
      headroom.add(bed.centres[i], bed.packing.radii[i]);
    }
  }
}

} // namespace

TEST_CASE("headroom excludes the radii that fit nowhere under the lid and no others") {
  excludes_what_fits_nowhere<2>(false);
  excludes_what_fits_nowhere<2>(true);
  excludes_what_fits_nowhere<3>(false);
  excludes_what_fits_nowhere<3>(true);
}

TEST_CASE("a radius that headroom excludes ends above the lid wherever it is dropped") {
  const Bed<3> bed(false, 9);
  const std::vector<SizeClass> classes = {{4.0, 20.0}, {1.0, 200.0}};
  HierarchicalGrid<3> grid(bed.size, bed.periodic, classes);
  Headroom<3> headroom(bed.size, bed.periodic, grid);
  Descent<3> descent(bed.size, bed.periodic, grid);
  RandomStream random("drops", 1);
  int excluded = 0;
  for (std::size_t i = 0; i < bed.centres.size(); ++i) {
    grid.insert(bed.centres[i], bed.packing.radii[i]);
    headroom.add(bed.centres[i], bed.packing.radii[i]);
    const double radius = 0.3 + 1.5 * random.uniform();
    if (!headroom.excludes(radius))
      continue;
    for (int drop = 0; drop < 20; ++drop) {
      Vec<3> p;
      for (int a = 0; a < 2; ++a)
        p[a] = radius + random.uniform() * (bed.size[a] - 2 * radius);
      p[2] = 2 * bed.size[2];
      CHECK(descent.run(p, radius) == Descent<3>::End::stable);
      CHECK(p[2] + radius > bed.size[2]);
    }
    ++excluded;
  }
  CHECK(excluded > 20);
}
