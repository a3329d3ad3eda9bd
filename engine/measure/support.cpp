// Non-negative least squares in two or three rows.
#include "engine/measure/support.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp {

namespace {

/// Cosine below which a contact no longer opposes what is left of gravity: rounding of unit vectors.
constexpr double kOpposes = 1e-14;

/// Each pass lowers the residual, so the search ends; rounding could make it circle among equals.
constexpr int kMaxPasses = 1000;

/// The contacts that press, at most D because they are independent, with their multipliers.
template <int D>
struct Pressing {
  std::array<Vec<D>, D> normal;
  std::array<double, D> lambda{};
  int count = 0;

  void remove(int i) {
    --count;
    normal[static_cast<std::size_t>(i)] = normal[static_cast<std::size_t>(count)];
    lambda[static_cast<std::size_t>(i)] = lambda[static_cast<std::size_t>(count)];
  }

  /// Least squares over the pressing contacts, stepping back to where the first of them would pull and leaving it out.
  void solve() {
    while (count > 0) {
      Eigen::Matrix<double, D, Eigen::Dynamic, 0, D, D> a(D, count);
      for (int i = 0; i < count; ++i)
        a.col(i) = normal[static_cast<std::size_t>(i)];
      const Eigen::VectorXd wanted = a.colPivHouseholderQr().solve(Vec<D>::Unit(vertical<D>));
      double step = 1;
      int first = -1;
      for (int i = 0; i < count; ++i) {
        const double now = lambda[static_cast<std::size_t>(i)];
        if (wanted[i] <= 0 && now / (now - wanted[i]) < step) {
          step = now / (now - wanted[i]);
          first = i;
        }
      }
      for (int i = 0; i < count; ++i) {
        double& now = lambda[static_cast<std::size_t>(i)];
        now += step * (wanted[i] - now);
      }
      if (first < 0)
        return;
      remove(first);
    }
  }

  [[nodiscard]] Vec<D> residual() const {
    Vec<D> r = Vec<D>::Unit(vertical<D>);
    for (int i = 0; i < count; ++i)
      r -= lambda[static_cast<std::size_t>(i)] * normal[static_cast<std::size_t>(i)];
    return r;
  }
};

} // namespace

template <int D>
double free_descent(std::span<const Vec<D>> normals) {
  Pressing<D> pressing;
  Vec<D> left = Vec<D>::Unit(vertical<D>);
  for (int pass = 0; pass < kMaxPasses && pressing.count < D; ++pass) {
    const auto strongest = std::max_element(
        normals.begin(), normals.end(), [&](const Vec<D>& a, const Vec<D>& b) { return a.dot(left) < b.dot(left); });
    if (strongest == normals.end() || strongest->dot(left) <= kOpposes)
      break;
    pressing.normal[static_cast<std::size_t>(pressing.count)] = *strongest;
    pressing.lambda[static_cast<std::size_t>(pressing.count)] = 0;
    ++pressing.count;
    pressing.solve();
    left = pressing.residual();
  }
  return left.norm();
}

template double free_descent<2>(std::span<const Vec<2>>);
template double free_descent<3>(std::span<const Vec<3>>);

} // namespace tamp
