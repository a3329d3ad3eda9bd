// Accelerated projected gradients on the contact network.
#include "engine/measure/load_network.h"

#include "engine/base/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

/// Steps between two looks at how far the optimum is.
constexpr std::int64_t kLook = 20;

/// n × F over the radius, against the turn: what a force at the contact does to either sphere.
Moment<2> moment_of(const Vec<2>& n, const Vec<2>& F) {
  return Moment<2>(n[1] * F[0] - n[0] * F[1]);
}
Moment<3> moment_of(const Vec<3>& n, const Vec<3>& F) {
  return F.cross(n);
}
/// The transpose of moment_of(n, ·).
Vec<2> lever(const Vec<2>& n, const Moment<2>& T) {
  return {n[1] * T[0], -n[0] * T[0]};
}
Vec<3> lever(const Vec<3>& n, const Moment<3>& T) {
  return n.cross(T);
}

/// The nearest force that pushes and, tangentially, does not exceed μ times that.
template <int D>
struct CoulombCone {
  static constexpr bool kTurns = true;
  double mu;
  Vec<D> operator()(const Vec<D>& F, const Vec<D>& n) const {
    const double along = F.dot(n);
    const Vec<D> across = F - along * n;
    const double t = across.norm();
    if (t <= mu * along)
      return F;
    const double f = (along + mu * t) / (1 + mu * mu); // on the cone's face nearest to F
    return f > 0 ? Vec<D>(f * n + (mu * f / t) * across) : Vec<D>(Vec<D>::Zero());
  }
};
template <int D>
struct PushAlone {
  static constexpr bool kTurns = false;
  Vec<D> operator()(const Vec<D>& F, const Vec<D>& n) const { return std::max(0.0, F.dot(n)) * n; }
};

template <int D, class Cone>
class Solver {
public:
  Solver(std::span<const LoadContact<D>> contacts, std::span<const double> weights, Cone cone)
      : contacts_(contacts), weights_(weights), cone_(cone), start_(weights.size() + 1, 0), step_(contacts.size()) {
    for (const LoadContact<D>& c : contacts) {
      ++start_[c.i + 1];
      if (c.j != LoadContact<D>::kWall)
        ++start_[c.j + 1];
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
      start_[i + 1] += start_[i];
    ends_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      ends_[next[contacts[k].i]++] = {static_cast<std::uint32_t>(k), -1};
      if (contacts[k].j != LoadContact<D>::kWall)
        ends_[next[contacts[k].j]++] = {static_cast<std::uint32_t>(k), 1};
    }
    // Row sums of the blocks of the normal matrix bound it from above (Gershgorin): one for each contact of either end.
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const LoadContact<D>& c = contacts[k];
      const std::size_t met = degree(c.i) + (c.j == LoadContact<D>::kWall ? 0 : degree(c.j));
      step_[k] = 1 / static_cast<double>((Cone::kTurns ? 2 : 1) * met);
    }
  }

  LoadNetwork<D> solve(const LoadTolerance& tolerance) {
    LoadNetwork<D> out;
    const std::size_t n = contacts_.size();
    std::vector<Vec<D>> x(n, Vec<D>::Zero());
    std::vector<Vec<D>> last = x;
    std::vector<Vec<D>> y = x;
    out.residual.resize(weights_.size());
    out.moment.assign(weights_.size(), Moment<D>::Zero());
    double momentum = 1;
    for (out.steps = 0; out.steps < tolerance.steps && n > 0; ++out.steps) {
      balance(y, out);
      std::swap(last, x);
      parallel_for(
          n, [&](std::size_t k) { x[k] = cone_(y[k] - step_[k] * gradient(contacts_[k], out), contacts_[k].normal); });
      const double against =
          parallel_sum<double>(n, [&](std::size_t k) { return (y[k] - x[k]).dot(x[k] - last[k]) / step_[k]; });
      const double next = against > 0 ? 1 : (1 + std::sqrt(1 + 4 * momentum * momentum)) / 2;
      const double beta = against > 0 ? 0 : (momentum - 1) / next;
      if (out.steps % kLook == 0) {
        out.violation = 0;
        for (std::size_t k = 0; k < n; ++k)
          out.violation = std::max(out.violation, (y[k] - x[k]).norm() / step_[k]);
        if (out.violation < tolerance.optimal || rms(out) < tolerance.balanced)
          break;
      }
      parallel_for(n, [&](std::size_t k) { y[k] = x[k] + beta * (x[k] - last[k]); });
      momentum = next;
    }
    balance(x, out);
    out.forces = std::move(x);
    return out;
  }

private:
  struct End {
    std::uint32_t contact;
    int sign; ///< of the contact's force on this sphere
  };

  [[nodiscard]] std::size_t degree(std::size_t i) const { return start_[i + 1] - start_[i]; }

  void balance(const std::vector<Vec<D>>& forces, LoadNetwork<D>& out) const {
    parallel_for(weights_.size(), [&](std::size_t i) {
      Vec<D> net = Vec<D>::Zero();
      net[vertical<D>] = -weights_[i];
      Moment<D> turn = Moment<D>::Zero();
      for (std::size_t e = start_[i]; e < start_[i + 1]; ++e) {
        const Vec<D>& F = forces[ends_[e].contact];
        net += ends_[e].sign * F;
        if constexpr (Cone::kTurns)
          turn += moment_of(contacts_[ends_[e].contact].normal, F);
      }
      out.residual[i] = net;
      if constexpr (Cone::kTurns)
        out.moment[i] = turn;
    });
  }

  [[nodiscard]] Vec<D> gradient(const LoadContact<D>& c, const LoadNetwork<D>& out) const {
    const bool wall = c.j == LoadContact<D>::kWall;
    Vec<D> g = -out.residual[c.i];
    if (!wall)
      g += out.residual[c.j];
    if constexpr (Cone::kTurns) {
      Moment<D> turn = out.moment[c.i];
      if (!wall)
        turn += out.moment[c.j];
      g += lever(c.normal, turn);
    }
    return g;
  }

  [[nodiscard]] double rms(const LoadNetwork<D>& out) const {
    const double sum = parallel_sum<double>(
        weights_.size(), [&](std::size_t i) { return out.residual[i].squaredNorm() + out.moment[i].squaredNorm(); });
    return std::sqrt(sum / static_cast<double>(weights_.size()));
  }

  std::span<const LoadContact<D>> contacts_;
  std::span<const double> weights_;
  Cone cone_;
  std::vector<std::size_t> start_; ///< of each sphere's ends; one more at the end
  std::vector<End> ends_;
  std::vector<double> step_;
};

} // namespace

template <int D>
LoadNetwork<D> carry_load(std::span<const LoadContact<D>> contacts, std::span<const double> weights, double mu,
                          const LoadTolerance& tolerance) {
  double mean = 0;
  for (const double weight : weights)
    mean += weight / static_cast<double>(weights.size());
  std::vector<double> relative(weights.begin(), weights.end());
  for (double& weight : relative)
    weight /= mean;
  return mu > 0 ? Solver<D, CoulombCone<D>>(contacts, relative, {mu}).solve(tolerance)
                : Solver<D, PushAlone<D>>(contacts, relative, {}).solve(tolerance);
}

template LoadNetwork<2> carry_load(std::span<const LoadContact<2>>, std::span<const double>, double,
                                   const LoadTolerance&);
template LoadNetwork<3> carry_load(std::span<const LoadContact<3>>, std::span<const double>, double,
                                   const LoadTolerance&);

} // namespace tamp
