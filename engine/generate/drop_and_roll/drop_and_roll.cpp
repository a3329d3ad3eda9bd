// The outer loop of drop-and-roll: draw, drop, keep or fail, until nothing more fits.
#include "engine/generate/drop_and_roll/drop_and_roll.h"

#include "engine/base/random.h"
#include "engine/generate/drop_and_roll/descent.h"
#include "engine/generate/drop_and_roll/headroom.h"
#include "engine/generate/radius_sampler.h"
#include "engine/model/size_law.h"
#include "engine/search/hierarchical_grid.h"
#include "engine/search/skyline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp {

namespace {

/// Placed spheres between two calls of the progress function.
constexpr std::size_t kProgressStride = 4096;

double expected_count(const Scene& scene, const SizeLaw& law) {
  if (scene.count > 0)
    return static_cast<double>(scene.count);
  return std::max(1.0, full_box_count(scene, law));
}

/// The box of the grid: without a lid as high as the bed is expected to grow, with a margin, lest all that lies above
/// the box is searched one by one.
template <int D>
Vec<D> grid_box(const Job& job, const SizeLaw& law) {
  constexpr double margin = 2;
  Vec<D> box = Eigen::Map<const Vec<D>>(job.scene.size.data());
  if (!job.method.drop_and_roll.lid) {
    const double filled = static_cast<double>(job.scene.count) / std::max(1.0, full_box_count(job.scene, law));
    box[vertical<D>] *= std::max(1.0, margin * filled);
  }
  return box;
}

/// Ratio of radii within one class of the grid. Measured in 3D, from 2.5 to 4 the time changes by less than its noise:
/// each class is one more search a sphere, each factor one more look at spheres out of reach. 2 and 8 are slower.
constexpr double kClassRatio = 2.8;

/// Size classes from the largest radius of the law down to its smallest.
std::vector<SizeClass> size_classes(const SizeLaw& law, double expected) {
  std::vector<SizeClass> classes;
  for (double top = law.largest(); top >= law.smallest(); top /= kClassRatio) {
    const double share = law.cdf(top) - law.cdf(top / kClassRatio);
    classes.push_back({top, expected * share});
  }
  return classes;
}

template <int D>
class DropAndRollRun {
public:
  DropAndRollRun(const Job& job, std::string_view key)
      : job_(job), law_(job.scene.psd, D), expected_(expected_count(job.scene, law_)),
        size_(Eigen::Map<const Vec<D>>(job.scene.size.data())), periodic_(lateral(job.scene.sides == Sides::periodic)),
        grid_(grid_box<D>(job, law_), periodic_, size_classes(law_, expected_)),
        skyline_(size_, periodic_, std::pow(expected_, (D - 1.0) / D)), descent_(size_, periodic_, grid_),
        headroom_(size_, periodic_, grid_),
        radii_(law_, job.scene.sampler, static_cast<std::uint64_t>(std::ceil(expected_)),
               RandomStream(key, static_cast<std::uint64_t>(Stream::radii))),
        positions_(key, static_cast<std::uint64_t>(Stream::positions)) {}

  Generated run(const Progress& progress) {
    const DropAndRoll& method = job_.method.drop_and_roll;
    const auto wanted = static_cast<std::size_t>(job_.scene.count);
    std::int64_t failures_in_row = 0;
    double radius = radii_.next();
    while (failures_in_row < method.max_failures && (wanted == 0 || placed() < wanted)) {
      ++attempts_;
      if (drop(radius)) {
        failures_in_row = 0;
        radius = radii_.next();
        if (progress && placed() % kProgressStride == 0)
          progress(placed());
      } else {
        ++failures_in_row;
        ++failures_;
        full_ = is_full(radius);
        if (full_)
          break;
        if (method.on_failure == OnFailure::redraw)
          radius = radii_.next();
      }
    }
    return result(wanted);
  }

private:
  static std::array<bool, D> lateral(bool periodic) {
    std::array<bool, D> flags{};
    for (int a = 0; a < D - 1; ++a)
      flags[static_cast<std::size_t>(a)] = periodic;
    return flags;
  }

  [[nodiscard]] std::size_t placed() const { return packing_.radii.size(); }

  /// One attempt: true if the sphere came to rest inside the box.
  bool drop(double radius) {
    Vec<D> p = Vec<D>::Zero();
    for (int a = 0; a < D - 1; ++a) {
      const double u = positions_.uniform();
      p[a] = periodic_[static_cast<std::size_t>(a)] ? u * size_[a] : radius + u * (size_[a] - 2 * radius);
    }
    if (job_.method.drop_and_roll.lid && headroom_.excludes(radius)) {
      ++excluded_;
      return false;
    }
    p[vertical<D>] = skyline_.above(p, radius) + radius;
    if (descent_.run(p, radius) == Descent<D>::End::unresolved) {
      ++unresolved_;
      return false;
    }
    if (job_.method.drop_and_roll.lid && p[vertical<D>] + radius > size_[vertical<D>])
      return false;
    place(p, radius);
    return true;
  }

  /// Whether no attempt can succeed any more: then the failures that are still missing would only cost time.
  bool is_full(double radius) {
    const DropAndRoll& method = job_.method.drop_and_roll;
    return method.lid && headroom_.excludes(method.on_failure == OnFailure::keep ? radius : law_.smallest());
  }

  void place(Vec<D>& p, double radius) {
    for (int a = 0; a < D - 1; ++a) {
      if (periodic_[static_cast<std::size_t>(a)])
        p[a] -= std::floor(p[a] / size_[a]) * size_[a];
    }
    grid_.insert(p, radius);
    skyline_.raise(p, radius);
    headroom_.add(p, radius);
    packing_.positions.insert(packing_.positions.end(), p.data(), p.data() + D);
    packing_.radii.push_back(radius);
  }

  Generated result(std::size_t wanted) {
    Generated out;
    packing_.dimension = D;
    packing_.unit = job_.scene.unit;
    for (int a = 0; a < D; ++a) {
      const auto n = static_cast<std::size_t>(a);
      packing_.size[n] = size_[a];
      packing_.boundary[n] = periodic_[n] ? Boundary::periodic : Boundary::wall;
    }
    if (!job_.method.drop_and_roll.lid)
      packing_.boundary[static_cast<std::size_t>(vertical<D>)] = Boundary::open;
    if (placed() < wanted) {
      out.outcome = Outcome::did_not_converge;
      const std::string proof = full_ ? std::string("no radius fits under the lid any more")
                                      : fmt::format("{} failures in a row", job_.method.drop_and_roll.max_failures);
      out.reason = fmt::format("the box was full at {} of {} spheres ({})", placed(), wanted, proof);
    }
    const auto count = [](std::uint64_t n) { return static_cast<double>(n); };
    out.measures = {{"N", count(placed()), "1"},
                    {"attempts", count(attempts_), "1"},
                    {"failures", count(failures_), "1"},
                    {"excluded", count(excluded_), "1"},
                    {"unresolved", count(unresolved_), "1"},
                    {"events", count(descent_.events()), "1"}};
    out.packing = std::move(packing_);
    return out;
  }

  const Job& job_;
  SizeLaw law_;
  double expected_;
  Vec<D> size_;
  std::array<bool, D> periodic_;
  HierarchicalGrid<D> grid_;
  Skyline<D> skyline_;
  Descent<D> descent_;
  Headroom<D> headroom_;
  RadiusSampler radii_;
  RandomStream positions_;
  Packing packing_;
  std::uint64_t attempts_ = 0;
  std::uint64_t failures_ = 0;
  std::uint64_t excluded_ = 0; ///< of the failures: those proven beforehand
  bool full_ = false;
  std::uint64_t unresolved_ = 0;
};

} // namespace

Generated generate_drop_and_roll(const Request& request) {
  return with_dimension(request.job.scene.dimension,
                        [&](auto d) { return DropAndRollRun<d>(request.job, request.key).run(request.progress); });
}

} // namespace tamp
