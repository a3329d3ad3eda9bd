// Caps, wedges and corners of a unit ball, and their sum over the faces of a box.
#include "engine/measure/ball_in_box.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Half chord at the distance h from the centre; 1 − h² without its cancellation near h = 1.
double half_chord(double h) {
  return std::sqrt((1 - h) * (1 + h));
}

/// Unit disc beyond x = a and y = b; 0 ≤ a, b and a² + b² < 1.
double disc_corner(double a, double b) {
  const double ca = half_chord(a);
  const double cb = half_chord(b);
  const double arc = std::atan2(ca, a) - std::atan2(b, cb);
  return (arc - a * (ca - b) - b * (cb - a)) / 2;
}

/// Unit ball beyond x = a and y = b; 0 ≤ a, b and a² + b² < 1.
double ball_wedge(double a, double b) {
  const double c = std::sqrt(std::max(0.0, (1 - a) * (1 + a) - b * b)); // the planes meet the sphere at z = ±c
  const double alpha = std::atan2(c, b);                                // half the arc of the sphere in the plane x = a
  const double beta = std::atan2(c, a);
  return (2 * std::atan2(c, a * b) + 2 * a * b * c - a * alpha * (3 - a * a) - b * beta * (3 - b * b)) / 3;
}

/// Unit ball beyond x = h0, y = h1 and z = h2; all ≥ 0, sum of squares < 1.
double ball_corner(const std::array<double, 3>& h) {
  double surface = -kPi; // Gauss-Bonnet: the angles at the three vertices less the turning along the three arcs
  double flat = 0;       // Σ distance × face
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = h[i];
    const double b = h[(i + 1) % 3];
    const double k = h[(i + 2) % 3];
    const double cab = std::sqrt(std::max(0.0, (1 - a) * (1 + a) - b * b));
    const double cak = std::sqrt(std::max(0.0, (1 - a) * (1 + a) - k * k));
    surface += std::atan2(cab, a * b);
    surface -= a * (std::atan2(cab, b) - std::atan2(k, cak));
    const double rho = half_chord(a);
    flat += a * rho * rho * disc_corner(b / rho, k / rho);
  }
  return (surface - flat) / 3;
}

/// Part of the unit ball beyond m perpendicular planes at signed distances h[0 … m) from the centre.
template <int D>
double beyond(const std::array<double, D>& h, std::size_t m) {
  double squares = 0;
  for (std::size_t i = 0; i < m; ++i) {
    if (h[i] < 0) { // all beyond the other planes, less what is on this side of this one
      std::array<double, D> others = h;
      std::swap(others[i], others[m - 1]);
      std::array<double, D> mirrored = h;
      mirrored[i] = -h[i];
      return beyond<D>(others, m - 1) - beyond<D>(mirrored, m);
    }
    squares += h[i] * h[i];
  }
  if (m == 0)
    return kUnitBall<D>;
  if (squares >= 1)
    return 0;
  if (m == 1)
    return cap_of_unit_ball<D>(h[0]);
  double piece = 0;
  if constexpr (D == 2)
    piece = disc_corner(h[0], h[1]);
  else
    piece = m == 2 ? ball_wedge(h[0], h[1]) : ball_corner(h);
  return std::max(0.0, piece);
}

/// Part of the unit ball inside the slabs −below ≤ x ≤ above of the axes from `axis` on, and beyond the m planes h.
template <int D>
double inside(const Vec<D>& below, const Vec<D>& above, int axis, const std::array<double, D>& h, std::size_t m) {
  if (axis == D)
    return beyond<D>(h, m);
  double sum = inside<D>(below, above, axis + 1, h, m);
  for (const double face : {below[axis], above[axis]}) {
    if (face >= 1)
      continue;
    std::array<double, D> more = h;
    more[m] = face;
    sum -= inside<D>(below, above, axis + 1, more, m + 1);
  }
  return sum;
}

} // namespace

template <int D>
double cap_of_unit_ball(double h) {
  if constexpr (D == 2) {
    const double c = half_chord(h);
    return std::max(0.0, std::atan2(c, h) - h * c);
  } else {
    return kPi * (1 - h) * (1 - h) * (2 + h) / 3;
  }
}

template <int D>
double ball_in_box(const Vec<D>& centre, double radius, const Vec<D>& low, const Vec<D>& high) {
  const Vec<D> below = (centre - low) / radius; // signed distances of the faces, positive where the centre is inside
  const Vec<D> above = (high - centre) / radius;
  if (below.minCoeff() <= -1 || above.minCoeff() <= -1)
    return 0;
  const double box = (high - low).prod();
  if (below.cwiseAbs().cwiseMax(above.cwiseAbs()).squaredNorm() <= 1)
    return box; // the farthest corner is inside the ball
  const double ball = std::pow(radius, D);
  return std::clamp(ball * inside<D>(below, above, 0, {}, 0), 0.0, std::min(box, ball * kUnitBall<D>));
}

template double cap_of_unit_ball<2>(double);
template double cap_of_unit_ball<3>(double);
template double ball_in_box<2>(const Vec<2>&, double, const Vec<2>&, const Vec<2>&);
template double ball_in_box<3>(const Vec<3>&, double, const Vec<3>&, const Vec<3>&);

} // namespace tamp
