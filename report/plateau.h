// Convergence with the size of the box: from which size on a quantity stays near its value in the largest box.
#pragma once

#include "report/statistics.h"

#include <optional>
#include <span>
#include <string>

namespace tamp {

/// A quantity in boxes of one size.
struct SizePoint {
  double size;
  Summary value;
};

/// What counts as converged; in units of the quantity.
struct PlateauCriterion {
  double tolerance; ///< largest distance of a mean from the plateau
  double spread;    ///< largest standard deviation over replicates
};

/// A representative volume in the sense of Kanit et al. (2003): the smallest box from which on every mean lies within
/// the tolerance of the plateau, which is the mean in the largest box, and every spread under its bound. The largest
/// box alone proves nothing, as its mean is the plateau by definition: then, or with fewer than two replicates
/// somewhere on the plateau, there is none.
struct Plateau {
  double value; ///< mean in the largest box
  std::optional<double> size;
  std::string why_none; ///< empty if there is a size
};

/// Points by increasing size, at least one; else InputError.
Plateau find_plateau(std::span<const SizePoint> points, const PlateauCriterion& criterion);

} // namespace tamp
