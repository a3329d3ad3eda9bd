// Isostatic compression with friction and adhesion: closed forms of a lattice under load, densities of random packings,
// and the same bytes whatever happens on the way.
#include "engine/base/random.h"
#include "engine/contact/jkr.h"
#include "engine/dem/compress.h"
#include "engine/search/contact_search.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>

using namespace tamp;

namespace {

/// Contacts of the stiffness E* and no other, under a load of 1.
template <int D>
void set_contacts(CompressTask<D>& task, double friction, double modulus) {
  task.effects.friction = friction > 0;
  task.friction = friction;
  task.modulus = modulus;
  task.largest_modulus = modulus;
}

/// n^3 spheres of radius 1 on a simple cubic lattice with gaps.
CompressTask<3> cubic(std::size_t n) {
  CompressTask<3> task;
  task.size.setConstant(2.01 * static_cast<double>(n));
  for (std::size_t i = 0; i < n * n * n; ++i) {
    task.radii.push_back(1);
    for (const std::size_t k : {i / (n * n), i / n % n, i % n})
      task.positions.push_back(2.01 * static_cast<double>(k));
  }
  task.overlap = 0.1;
  return task;
}

/// n spheres or discs without contact at a packing fraction of 0.25, radii over [1, ratio].
template <int D>
CompressTask<D> loose(std::size_t n, double ratio, std::uint64_t seed, double friction) {
  CompressTask<D> task;
  RandomStream draw("press", seed);
  double solid = 0;
  for (std::size_t i = 0; i < n; ++i) {
    task.radii.push_back(1 + (ratio - 1) * draw.uniform());
    solid += (D == 2 ? std::numbers::pi : 4 * std::numbers::pi / 3) * std::pow(task.radii.back(), D);
  }
  std::sort(task.radii.begin(), task.radii.end(), std::greater<>());
  task.size.setConstant(std::pow(solid / 0.25, 1.0 / D));
  std::vector<Vec<D>> centres;
  while (centres.size() < n) {
    Vec<D> c;
    for (int a = 0; a < D; ++a)
      c[a] = draw.uniform() * task.size[0];
    bool free = true;
    for (std::size_t j = 0; j < centres.size() && free; ++j) {
      Vec<D> d = c - centres[j];
      for (int a = 0; a < D; ++a)
        d[a] -= task.size[a] * std::round(d[a] / task.size[a]);
      free = d.norm() > task.radii[j] + task.radii[centres.size()];
    }
    if (free)
      centres.push_back(c);
  }
  for (const Vec<D>& c : centres)
    task.positions.insert(task.positions.end(), c.data(), c.data() + D);
  task.overlap = 1e-2;
  set_contacts(task, friction, 100);
  task.largest_modulus = 1e9;
  return task;
}

template <int D>
bool same_bytes(const Compressed<D>& a, const Compressed<D>& b) {
  return a.end == b.end && a.size == b.size && a.positions == b.positions && a.overlap == b.overlap &&
         a.evaluations == b.evaluations;
}

/// Contacts a sphere, all counted.
template <int D>
double contacts(const CompressTask<D>& task, const Compressed<D>& end) {
  SearchBox<D> box;
  box.size = end.size;
  box.periodic.fill(true);
  double ends = 0;
  ContactSearch<D>(box, end.positions, task.radii).for_each_pair(0, [&](const SpherePair<D>&) { ends += 2; });
  return ends / static_cast<double>(task.radii.size());
}

} // namespace

TEST_CASE("a cubic lattice under load overlaps as Hertz, Derjaguin-Muller-Toporov and JKR say") {
  constexpr double modulus = 1e4;
  constexpr double R = 0.5;
  auto task = cubic(4);
  set_contacts(task, 0.5, modulus);
  const auto overlap_under = [&](double adhesion, AdhesionLaw law) {
    task.adhesion = adhesion;
    task.effects.adhesion = law;
    const auto end = compress(task);
    CHECK(end.end == CompressEnd::done);
    CHECK(end.size[0] == Approx(4 * (2 - end.overlap)).epsilon(1e-6)); // every contact alike
    return std::pair(end.overlap, end.pressure);
  };
  // Each contact bears the load on the face of its cell, and what adhesion adds.
  const auto [hertz, hertz_load] = overlap_under(0, AdhesionLaw::none);
  CHECK(hertz_load == Approx(1).epsilon(0.03));
  const auto hertz_overlap = [&](double force) { return std::pow(0.75 * force / (modulus * std::sqrt(R)), 2.0 / 3); };
  const auto face = [](double overlap) { return (2 - overlap) * (2 - overlap); };
  CHECK(hertz == Approx(hertz_overlap(hertz_load * face(hertz))).epsilon(1e-6));

  const auto [dmt, dmt_load] = overlap_under(1, AdhesionLaw::dmt);
  CHECK(dmt == Approx(hertz_overlap(dmt_load * face(dmt) + 2 * std::numbers::pi * R)).epsilon(1e-6));

  const auto [jkr, jkr_load] = overlap_under(1, AdhesionLaw::jkr);
  CHECK(Jkr{modulus, 1}.at(jkr, R).force == Approx(jkr_load * face(jkr)).epsilon(1e-6));
}

TEST_CASE("friction makes jammed packings looser, and adhesion looser still") {
  const auto smooth = loose<3>(600, 1.2, 1, 0.0);
  auto rough = loose<3>(600, 1.2, 1, 0.577);
  const auto jammed = compress(smooth);
  const auto rubbing = compress(rough);
  rough.effects.adhesion = AdhesionLaw::dmt;
  rough.adhesion = 1; // W/(p r) of about 1
  const auto sticking = compress(rough);
  for (const auto* end : {&jammed, &rubbing, &sticking})
    CHECK(end->end == CompressEnd::done);
  CHECK(rubbing.phi > 0.55); // 0.55 to 0.60 (random loose packing; Silbert, Soft Matter 6, 2918, 2010)
  CHECK(rubbing.phi < 0.60);
  CHECK(contacts(rough, rubbing) > 3.5); // four without rattlers
  CHECK(contacts(rough, rubbing) < 4.6);
  CHECK(jammed.phi > rubbing.phi + 0.03);
  CHECK(sticking.phi < rubbing.phi - 0.03);

  const auto discs = loose<2>(500, 1.8, 1, 0.577);
  const auto flat = compress(discs);
  CHECK(flat.end == CompressEnd::done);
  CHECK(flat.phi > 0.76); // 0.77 to 0.82 with friction, 0.84 without (Silbert 2010, Papanikolaou et al. 2013)
  CHECK(flat.phi < 0.83);
}

TEST_CASE("with friction a prescribed packing fraction is met exactly, or the packing is said to be jammed") {
  auto task = loose<3>(400, 1.5, 2, 0.3);
  task.target_phi = 0.55;
  const auto met = compress(task);
  CHECK(met.end == CompressEnd::done);
  CHECK(std::abs(met.phi - 0.55) < 1e-12);
  CHECK(met.overlap <= task.overlap);

  task.target_phi = 0.7;
  CHECK(compress(task).end == CompressEnd::jammed);
}

TEST_CASE("contacts that may become no stiffer keep the overlap that their load makes, and the end says so") {
  auto task = cubic(3);
  set_contacts(task, 0.5, 100);
  task.overlap = 1e-3;
  const auto end = compress(task);
  CHECK(end.end == CompressEnd::gave_up);
  CHECK(end.modulus == 100);
  CHECK(end.overlap > 1e-2);
}

TEST_CASE("pressing with friction has the same bytes on one thread and on two, and after a break") {
  auto task = loose<3>(4200, 1.5, 3, 0.5);
  task.overlap = 0.3;
  task.rate = 1e-2;
  const auto run = [&](std::size_t threads) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    return compress(task);
  };
  const auto whole = run(1);
  CHECK(same_bytes(whole, run(2)));
  REQUIRE(whole.evaluations > 400);

  const ScratchFolder folder;
  task.checkpoint = folder.path() / "state";
  task.checkpoint_every_s = 0;
  int looks = 0;
  task.progress = [&] {
    if (++looks == 3)
      throw std::runtime_error("killed");
  };
  CHECK_THROWS_AS(compress(task), std::runtime_error);
  REQUIRE(std::filesystem::exists(task.checkpoint));
  looks = 1000;
  CHECK(same_bytes(compress(task), whole));
  CHECK(looks < 1000 + static_cast<int>(whole.evaluations / 100)); // it did not begin from the start
}
