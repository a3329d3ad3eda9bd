// Ball∩box volumes against quadrature, Monte Carlo and their own symmetries.
#include "engine/base/random.h"
#include "engine/measure/ball_in_box.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace tamp;

namespace {

template <int D>
struct Case {
  Vec<D> centre;
  double radius;
  Vec<D> low;
  Vec<D> high;
};

/// Balls of 1/10 to 10 times a box of edges up to 3, near it.
template <int D>
Case<D> random_case(RandomStream& draw) {
  Case<D> c;
  c.radius = std::pow(10.0, 1.5 * draw.uniform() - 0.8);
  for (int a = 0; a < D; ++a) {
    c.low[a] = 2 * draw.uniform() - 1;
    c.high[a] = c.low[a] + 0.05 + 3 * draw.uniform();
    c.centre[a] = c.low[a] + (c.high[a] - c.low[a]) * (2 * draw.uniform() - 0.5);
  }
  return c;
}

template <int D>
double volume(const Case<D>& c) {
  return ball_in_box<D>(c.centre, c.radius, c.low, c.high);
}

/// The same volume as an integral over slices, cut where the slice begins to touch an edge or a corner of the box;
/// between two cuts p and q, x = p + (q − p) sin² t turns the square roots at both ends into smooth functions.
double sliced(const double* centre, double radius, const double* low, const double* high, int dimension) {
  const double a = std::max(low[0] - centre[0], -radius);
  const double b = std::min(high[0] - centre[0], radius);
  if (a >= b || radius <= 0)
    return 0;
  if (dimension == 1)
    return b - a;
  std::vector<double> stops{a, b};
  const auto stop_at = [&](double squared) {
    const double x = std::sqrt(std::max(0.0, radius * radius - squared));
    for (const double at : {x, -x}) {
      if (at > a && at < b)
        stops.push_back(at);
    }
  };
  std::vector<double> squares{0};
  for (int axis = 1; axis < dimension; ++axis) {
    const std::size_t known = squares.size();
    for (std::size_t k = 0; k < known; ++k) {
      squares.push_back(squares[k] + std::pow(low[axis] - centre[axis], 2));
      squares.push_back(squares[k] + std::pow(high[axis] - centre[axis], 2));
    }
  }
  for (const double squared : squares)
    stop_at(squared);
  std::sort(stops.begin(), stops.end());
  double sum = 0;
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    const double from = stops[k];
    const double wide = stops[k + 1] - from;
    if (wide <= 0)
      continue;
    const auto slice = [&](double t) {
      const double x = from + wide * std::sin(t) * std::sin(t);
      const double rest = std::sqrt(std::max(0.0, (radius - x) * (radius + x)));
      return wide * std::sin(2 * t) * sliced(centre + 1, rest, low + 1, high + 1, dimension - 1);
    };
    constexpr double kQuarterTurn = 1.5707963267948966;
    sum += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(slice, 0, kQuarterTurn, 3, 1e-11);
  }
  return sum;
}

template <int D>
void compare_with_quadrature(std::uint64_t seeds, double tolerance) {
  int cut = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    RandomStream draw("ball in box", seed);
    const auto c = random_case<D>(draw);
    const double expected = sliced(c.centre.data(), c.radius, c.low.data(), c.high.data(), D);
    CAPTURE(D, seed, c.radius, expected);
    const double ball = kUnitBall<D> * std::pow(c.radius, D);
    CHECK(std::abs(volume(c) - expected) <= tolerance * std::min(ball, std::max(expected, 1e-2 * ball)));
    cut += expected > 0 && expected < 0.999 * std::min(ball, (c.high - c.low).prod()) ? 1 : 0;
  }
  CHECK(cut > static_cast<int>(seeds / 4)); // most cases are neither wholly inside nor wholly outside
}

template <int D>
void compare_with_monte_carlo() {
  constexpr int kPoints = 100000;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    RandomStream draw("ball in box, points", seed);
    const auto c = random_case<D>(draw);
    int hits = 0;
    for (int k = 0; k < kPoints; ++k) {
      Vec<D> x;
      for (int a = 0; a < D; ++a)
        x[a] = c.low[a] + (c.high[a] - c.low[a]) * draw.uniform();
      hits += (x - c.centre).squaredNorm() < c.radius * c.radius ? 1 : 0;
    }
    const double box = (c.high - c.low).prod();
    const double share = static_cast<double>(hits) / kPoints;
    CAPTURE(D, seed);
    CHECK(std::abs(volume(c) / box - share) <= 5 * std::sqrt(std::max(share * (1 - share), 1e-5) / kPoints));
  }
}

template <int D>
void check_symmetries() {
  constexpr double kRounding = 1e-14;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomStream draw("ball in box, symmetry", seed);
    const auto c = random_case<D>(draw);
    const double whole = volume(c);
    const double ball = kUnitBall<D> * std::pow(c.radius, D);
    CAPTURE(D, seed, whole, ball);

    const int axis = static_cast<int>(draw.below(D));
    Case<D> left = c;
    Case<D> right = c;
    left.high[axis] = right.low[axis] = c.low[axis] + (c.high[axis] - c.low[axis]) * draw.uniform();
    CHECK(std::abs(volume(left) + volume(right) - whole) <= kRounding * ball);

    Case<D> larger = c;
    larger.centre *= 1e-6;
    larger.radius *= 1e-6;
    larger.low *= 1e-6;
    larger.high *= 1e-6;
    CHECK(std::abs(volume(larger) * std::pow(1e6, D) - whole) <= kRounding * ball);

    Case<D> moved = c;
    for (int a = 0; a < D; ++a) {
      const double shift = std::floor(10 * draw.uniform());
      moved.centre[a] += shift;
      moved.low[a] += shift;
      moved.high[a] += shift;
    }
    CHECK(std::abs(volume(moved) - whole) <= 1e-12 * std::max(ball, (c.high - c.low).prod()));

    Case<D> mirrored = c;
    mirrored.centre[axis] = -c.centre[axis];
    mirrored.low[axis] = -c.high[axis];
    mirrored.high[axis] = -c.low[axis];
    CHECK(std::abs(volume(mirrored) - whole) <= kRounding * ball);

    Case<D> turned = c;
    std::swap(turned.centre[0], turned.centre[1]);
    std::swap(turned.low[0], turned.low[1]);
    std::swap(turned.high[0], turned.high[1]);
    CHECK(std::abs(volume(turned) - whole) <= kRounding * ball);
  }
}

template <int D>
void check_containment() {
  const double ball = kUnitBall<D>;
  const Vec<D> zero = Vec<D>::Zero();
  const auto cube = [&](double from, double to) {
    return ball_in_box<D>(zero, 1, Vec<D>::Constant(from), Vec<D>::Constant(to));
  };
  CHECK(cube(-2, 2) == ball);
  CHECK(cube(-1, 1) == Approx(ball).epsilon(1e-15)); // touching every face from inside
  CHECK(cube(1, 2) == 0);                            // touching a face's plane from outside
  CHECK(cube(0, 2) == Approx(ball / (1 << D)).epsilon(1e-15));
  CHECK(cube(-1e-3, 1e-3) == Approx(std::pow(2e-3, D)).epsilon(1e-15)); // the ball holds the box
  CHECK(cube(-1e-9, 2) == Approx(ball / (1 << D)).epsilon(1e-8));
  const double inscribed = 1 / std::sqrt(D);
  CHECK(cube(-inscribed, inscribed) == Approx(std::pow(2 * inscribed, D)).epsilon(1e-15));
  CHECK(cube(inscribed, 2) <= 1e-15); // the ball reaches the corner at a point
  Vec<D> far = zero;
  far[0] = 5;
  CHECK(ball_in_box<D>(far, 1, Vec<D>::Constant(-1), Vec<D>::Constant(1)) == 0);
}

} // namespace

TEST_CASE("ball and box share what integration over slices says") {
  compare_with_quadrature<2>(400, 1e-12);
  compare_with_quadrature<3>(200, 1e-12);
}

TEST_CASE("ball and box share what points thrown at random say") {
  compare_with_monte_carlo<2>();
  compare_with_monte_carlo<3>();
}

TEST_CASE("the common volume is additive, and blind to shift, mirror, turn and unit") {
  check_symmetries<2>();
  check_symmetries<3>();
}

TEST_CASE("one body inside the other, touching, or apart") {
  check_containment<2>();
  check_containment<3>();
}

TEST_CASE("caps are those of the paper's equations") {
  for (const double d : {0.0, 0.3, 0.9, 0.999999, 1.0}) {
    CHECK(std::abs(cap_of_unit_ball<2>(d) - (std::acos(d) - d * std::sqrt(1 - d * d))) < 1e-12);
    const double h = 1 - d;
    CHECK(std::abs(cap_of_unit_ball<3>(d) - kUnitBall<3> / 4 * h * h * (3 - h)) < 4e-15);
  }
}
