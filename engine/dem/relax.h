// A bed without friction and adhesion comes to rest under its weight: energy is minimised, which has no time.
#pragma once

#include "engine/dem/settle.h"

namespace tamp {

/// Finds a minimum of elastic and gravitational energy near the task's spheres, first with contacts of the modulus that
/// the task starts with, then with stiffer and stiffer ones until overlaps are within its tolerance. The result has the
/// same bits on any number of threads, and however often the work was cut off and taken up again from its checkpoint.
template <int D>
Settled<D> relax(const SettleTask<D>& task);

extern template Settled<2> relax(const SettleTask<2>&);
extern template Settled<3> relax(const SettleTask<3>&);

} // namespace tamp
