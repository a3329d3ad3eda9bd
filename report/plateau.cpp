// Walks from the largest box down for as long as the criterion holds.
#include "report/plateau.h"

#include "engine/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

/// What keeps a point off the plateau; empty if nothing does.
std::string objection(const SizePoint& point, double plateau, const PlateauCriterion& criterion) {
  if (point.value.n < 2)
    return fmt::format("fewer than two replicates at {:g}, so no spread is known", point.size);
  if (!(point.value.sd <= criterion.spread))
    return fmt::format("the standard deviation at {:g} is {:.2g}, above {:g}", point.size, point.value.sd,
                       criterion.spread);
  if (const double away = std::abs(point.value.mean - plateau); !(away <= criterion.tolerance))
    return fmt::format("the mean at {:g} is {:.2g} from that of the largest box, more than {:g}", point.size, away,
                       criterion.tolerance);
  return {};
}

} // namespace

Plateau find_plateau(std::span<const SizePoint> points, const PlateauCriterion& criterion) {
  const auto unordered = [](const SizePoint& a, const SizePoint& b) { return a.size >= b.size; };
  if (points.empty() || std::adjacent_find(points.begin(), points.end(), unordered) != points.end())
    throw InputError("a plateau needs points of increasing size");
  Plateau plateau{points.back().value.mean, {}, {}};
  std::size_t first = points.size();
  while (first > 0) {
    plateau.why_none = objection(points[first - 1], plateau.value, criterion);
    if (!plateau.why_none.empty())
      break;
    --first;
  }
  if (points.size() - first >= 2) {
    plateau.size = points[first].size;
    plateau.why_none.clear();
  } else if (plateau.why_none.empty()) {
    plateau.why_none = "only one size of box";
  }
  return plateau;
}

} // namespace tamp
