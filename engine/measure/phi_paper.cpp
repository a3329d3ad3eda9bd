// Packing fraction by the paper's clipped estimator, for comparison with its tables.
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/measure/ball_in_box.h"
#include "engine/measure/metrics.h"
#include "engine/measure/sub_box.h"

#include <cmath>

namespace tamp {

namespace {

struct Retained {
  double measure = 0;
  double count = 0;

  Retained& operator+=(const Retained& other) {
    measure += other.measure;
    count += other.count;
    return *this;
  }
};

template <int D>
std::vector<Measure> phi_paper(const Metric& metric, const Packing& packing) {
  const SubBox<D> box = sub_box<D>(packing, metric.inset);
  const auto all = parallel_sum<Retained>(packing.count(), [&](std::size_t i) -> Retained {
    const Vec<D> x = wrapped_centre<D>(packing, i);
    if ((x.array() < box.low.array()).any() || (x.array() > box.high.array()).any())
      return {};
    const double r = packing.radii[i];
    double share = kUnitBall<D>;
    for (int a = 0; a < D; ++a) {
      for (const double d : {x[a] - box.low[a], box.high[a] - x[a]}) {
        // What two faces cut off together is taken away twice, as eq. (phiB) has it.
        if (d < r)
          share -= cap_of_unit_ball<D>(d / r);
      }
    }
    return {share * std::pow(r, D), 1};
  });
  if (all.count == 0)
    throw NotApplicable("the paper's estimator needs a sphere whose centre is inside the sub-box");
  return {{"phi_paper", all.measure / box.measure(), "1"}, {"N_PB", all.count, "1"}};
}

} // namespace

std::vector<Measure> measure_phi_paper(const Metric& metric, const Packing& packing, const Scene&) {
  return with_dimension(packing.dimension, [&](auto d) { return phi_paper<d>(metric, packing); });
}

} // namespace tamp
