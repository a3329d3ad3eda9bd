// Equilibrium under load: stacks with known forces, what cannot stand, and the optimum against an active-set solver.
#include "engine/measure/load_network.h"
#include "tests/engine/measure/packings.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

using namespace tamp;
using namespace tamp::test;

namespace {

double loaded(const char* name, const Packing& packing, double mu = 0, double gap = 1e-6) {
  Metric metric = metric_of(MetricName::stable_loaded);
  metric.friction = mu;
  metric.contact_gap = gap;
  return measured(name, packing, metric, {});
}

/// Two discs side by side on the floor and one in the saddle; walls touch the lower ones if the box fits them.
Packing three_discs(double edge) {
  Packing packing = box_of(2, edge);
  add(packing, {edge / 2 - 1, 1}, 1);
  add(packing, {edge / 2 + 1, 1}, 1);
  add(packing, {edge / 2, 1 + std::sqrt(3.0)}, 1);
  return packing;
}

/// Least ½ |A x + b|² over x ≥ 0 by Lawson & Hanson, Solving Least Squares Problems (1974), chapter 23.
double least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  constexpr double kRounding = 1e-12;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(A.cols());
  std::vector<Eigen::Index> free;
  for (;;) {
    const Eigen::VectorXd w = -A.transpose() * (A * x + b);
    Eigen::Index best = -1;
    for (Eigen::Index k = 0; k < A.cols(); ++k) {
      const bool is_free = std::find(free.begin(), free.end(), k) != free.end();
      if (!is_free && w[k] > kRounding && (best < 0 || w[k] > w[best]))
        best = k;
    }
    if (best < 0)
      return (A * x + b).squaredNorm();
    free.push_back(best);
    for (;;) {
      Eigen::MatrixXd part(A.rows(), static_cast<Eigen::Index>(free.size()));
      for (std::size_t k = 0; k < free.size(); ++k)
        part.col(static_cast<Eigen::Index>(k)) = A.col(free[k]);
      const Eigen::VectorXd z = part.completeOrthogonalDecomposition().solve(-b);
      double share = 1;
      for (std::size_t k = 0; k < free.size(); ++k) {
        const auto at = static_cast<Eigen::Index>(k);
        if (z[at] <= 0)
          share = std::min(share, x[free[k]] / (x[free[k]] - z[at]));
      }
      for (std::size_t k = 0; k < free.size(); ++k)
        x[free[k]] += share * (z[static_cast<Eigen::Index>(k)] - x[free[k]]);
      if (share == 1)
        break;
      std::erase_if(free, [&](Eigen::Index k) { return x[k] <= kRounding; });
    }
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      if (std::find(free.begin(), free.end(), k) == free.end())
        x[k] = 0;
    }
  }
}

} // namespace

TEST_CASE("in a column each contact carries what stands above it") {
  Packing column = box_of(3, 11); // the lid touches nothing
  for (int k = 0; k < 5; ++k)
    add(column, {5, 5, 1 + 2.0 * k}, 1);
  CHECK(loaded("loaded_residual", column) == Approx(0).margin(1e-4));
  CHECK(loaded("unbalanced", column) == 0);
  CHECK(loaded("loaded_force_max", column) == Approx(5).epsilon(1e-3));
}

TEST_CASE("three discs between walls carry known forces") {
  const Packing packing = three_discs(4);
  CHECK(loaded("unbalanced", packing) == 0);
  CHECK(loaded("loaded_residual", packing) == Approx(0).margin(1e-4));
  CHECK(loaded("loaded_force_max", packing) == Approx(1.5).epsilon(1e-3)); // of the floor
}

TEST_CASE("three discs without walls stand by friction of at least 2 - √3 alone") {
  // The upper disc pushes at 30° to the vertical; to turn neither disc the force must point along the chord at 15°.
  const Packing packing = three_discs(8);
  const double least = 2 - std::sqrt(3.0);
  CHECK(loaded("unbalanced", packing) > 0.5);
  CHECK(loaded("unbalanced", packing, 0.9 * least) > 0.5);
  CHECK(loaded("loaded_residual", packing, 0.9 * least) > 0.01);
  CHECK(loaded("unbalanced", packing, 1.01 * least) == 0);
  CHECK(loaded("loaded_residual", packing, 1.01 * least) < 1e-3);
}

TEST_CASE("what touches nothing keeps its whole weight, and an apex bears one exactly above") {
  Packing floating = box_of(3, 10);
  add(floating, {5, 5, 5}, 1);
  CHECK(loaded("loaded_residual", floating) == Approx(1));
  CHECK(loaded("unbalanced", floating) == 1);
  Packing apex = box_of(3, 10);
  add(apex, {5, 5, 1}, 1);
  add(apex, {5, 5, 3}, 1);
  CHECK(loaded("unbalanced", apex) == 0);
  add(apex, {5.5, 5, 3 + std::sqrt(3.75)}, 1); // off the apex: it would roll down
  CHECK(loaded("unbalanced", apex) > 0.3);
}

TEST_CASE("the residual is the least there is: an active-set solver finds the same") {
  for (const int dimension : {2, 3}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      RandomStream draw("load", seed);
      const Packing packing = random_packing(dimension, 25, 3.5, 1, Boundary::wall, draw);
      with_dimension(packing.dimension, [&](auto d) {
        constexpr int D = decltype(d)::value;
        // Contacts that the random overlaps make; weights as they come.
        std::vector<LoadContact<D>> contacts;
        std::vector<double> weights;
        for (std::size_t i = 0; i < packing.count(); ++i) {
          weights.push_back(packing.radii[i]);
          const Vec<D> a = packing.centre<D>(i);
          if (a[vertical<D>] < packing.radii[i])
            contacts.push_back({static_cast<std::uint32_t>(i), LoadContact<D>::kWall, -Vec<D>::Unit(vertical<D>)});
          for (std::size_t j = i + 1; j < packing.count(); ++j) {
            const Vec<D> apart = packing.centre<D>(j) - a;
            if (apart.norm() < packing.radii[i] + packing.radii[j])
              contacts.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), apart.normalized()});
          }
        }
        double mean = 0;
        for (const double weight : weights)
          mean += weight / static_cast<double>(weights.size());
        const auto rows = static_cast<Eigen::Index>(D * weights.size());
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(contacts.size()));
        Eigen::VectorXd b = Eigen::VectorXd::Zero(rows);
        for (std::size_t i = 0; i < weights.size(); ++i)
          b[static_cast<Eigen::Index>(D * i) + vertical<D>] = -weights[i] / mean;
        for (std::size_t k = 0; k < contacts.size(); ++k) {
          const auto column = static_cast<Eigen::Index>(k);
          A.col(column).template segment<D>(static_cast<Eigen::Index>(D * contacts[k].i)) = -contacts[k].normal;
          if (contacts[k].j != LoadContact<D>::kWall)
            A.col(column).template segment<D>(static_cast<Eigen::Index>(D * contacts[k].j)) = contacts[k].normal;
        }
        const double least = least_squares(A, b);
        const LoadNetwork<D> found = carry_load<D>(contacts, weights, 0, {1e-9, 1e-9, 200000});
        double squares = 0;
        for (const Vec<D>& residual : found.residual)
          squares += residual.squaredNorm();
        CAPTURE(dimension, seed, contacts.size(), found.steps);
        CHECK(squares == Approx(least).epsilon(1e-5).margin(1e-8));
        CHECK(squares >= least * (1 - 1e-9));
        for (std::size_t k = 0; k < contacts.size(); ++k)
          CHECK(found.forces[k].dot(contacts[k].normal) >= 0);
      });
    }
  }
}

TEST_CASE("friction never leaves more unbalanced than none, and keeps within the cone") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomStream draw("cone", seed);
    const Packing packing = random_packing(3, 60, 4, 1, Boundary::wall, draw);
    const double without = loaded("loaded_residual", packing);
    double last = without * (1 + 1e-3);
    for (const double mu : {0.1, 0.5, 2.0}) {
      // With friction the moment counts, too, but forces without it turn nothing: they stay allowed.
      const double now = loaded("loaded_residual", packing, mu);
      CAPTURE(seed, mu);
      CHECK(now <= last + 1e-3);
      last = now;
    }
  }
}
