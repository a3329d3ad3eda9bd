// Both density estimators on growing lattices: they converge to the analytic density as one over the edge.
#include "engine/generate/lattice.h"
#include "engine/measure/measure.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tamp;

namespace {

struct Row {
  LatticeKind kind;
  int dimension;
  double density;
};

using std::numbers::pi;

const std::vector<Row> kRows = {
    {LatticeKind::square, 2, pi / 4},
    {LatticeKind::hexagonal, 2, pi / std::sqrt(12)},
    {LatticeKind::sc, 3, pi / 6},
    {LatticeKind::bcc, 3, pi* std::sqrt(3) / 8},
    {LatticeKind::fcc, 3, pi / std::sqrt(18)},
    {LatticeKind::hcp, 3, pi / std::sqrt(18)},
};

double density(const Row& row, double edge, MetricName metric) {
  Job job;
  job.scene.dimension = row.dimension;
  job.scene.size.assign(static_cast<std::size_t>(row.dimension), edge);
  job.scene.psd.law = Law::monodisperse;
  job.scene.psd.radius = 1;
  job.method.name = MethodName::lattice;
  job.method.lattice.kind = row.kind;
  const Generated made = generate_lattice({job, "key"});
  REQUIRE(made.outcome == Outcome::ok);
  Metric m;
  m.name = metric;
  return measure(m, made.packing, job.scene).front().value;
}

/// Largest |error| × edge / radius over boxes from 10 to 80 radii: the constant C of the error law C / edge.
double error_constant(const Row& row, MetricName metric) {
  double worst = 0;
  for (double edge = 10; edge <= 80; edge += 3.5)
    worst = std::max(worst, std::abs(density(row, edge, metric) - row.density) * edge);
  return worst;
}

} // namespace

// The sub-box cuts the outermost layers at arbitrary heights, which costs each estimator a share of a surface layer:
// the error is at most C radii / edge and swings below that bound. Measured over edges from 10 to 80 radii: C = 0.11
// (hexagonal) to 0.90 (sc) for phi, of either sign; 2.3 to 3.3 for phi_paper, nearly always low.
TEST_CASE("both estimators converge to the density of a lattice as one over the edge") {
  for (const Row& row : kRows) {
    CAPTURE(name_of(row.kind));
    const double exact = error_constant(row, MetricName::phi);
    const double paper = error_constant(row, MetricName::phi_paper);
    CHECK(exact < 1.0);
    CHECK(paper < 3.5);
    CHECK(exact < paper / 2);
  }
}

TEST_CASE("a sub-box of whole cells gives the density of the lattice to rounding") {
  constexpr double kRounding = 1e-13;
  for (const Row& row : {kRows[0], kRows[2]}) {
    CAPTURE(name_of(row.kind));
    for (const double edge : {22.0, 62.0}) { // faces of the sub-box fall between layers: nothing is cut
      CHECK(std::abs(density(row, edge, MetricName::phi) - row.density) < kRounding);
      CHECK(std::abs(density(row, edge, MetricName::phi_paper) - row.density) < kRounding);
    }
    // Faces fall on the centres of a layer: cut in half, along edges in quarters, which the paper's estimator calls
    // empty.
    CHECK(std::abs(density(row, 42, MetricName::phi) - row.density) < kRounding);
    CHECK(density(row, 42, MetricName::phi_paper) < row.density - 1e-3);
  }
}
