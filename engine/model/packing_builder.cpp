// Order, box, dimension and sides of the spheres of a foreign file.
#include "engine/model/packing_builder.h"

#include "engine/base/line_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp {

namespace {

constexpr std::array<char, 3> kAxis = {'x', 'y', 'z'};
constexpr std::uintmax_t kShortestSphere = 8; // bytes of "0 0 0 1\n"

/// What the user states counts more than what the file says.
Surroundings merged(Surroundings said, const Surroundings& stated) {
  const auto prefer = [](auto& target, const auto& source) {
    if (source)
      target = source;
  };
  prefer(said.unit, stated.unit);
  prefer(said.dimension, stated.dimension);
  for (std::size_t a = 0; a < 3; ++a) {
    prefer(said.box[a], stated.box[a]);
    prefer(said.boundary[a], stated.boundary[a]);
  }
  return said;
}

} // namespace

void PackingBuilder::expect(std::int64_t count) {
  const auto possible = static_cast<std::int64_t>(file_size_ / kShortestSphere);
  spheres_.reserve(static_cast<std::size_t>(std::clamp<std::int64_t>(count, 0, possible)));
}

void PackingBuilder::add(std::size_t line, const std::array<double, 3>& centre, double radius,
                         std::optional<std::int64_t> number) {
  const std::int64_t id = number.value_or(static_cast<std::int64_t>(spheres_.size()) + 1);
  for (std::size_t a = 0; a < 3; ++a) {
    if (!std::isfinite(centre[a]))
      fail_in_line(path_, line, fmt::format("sphere {} has the coordinate {} = {}", id, kAxis[a], centre[a]));
  }
  if (!std::isfinite(radius) || radius <= 0)
    fail_in_line(path_, line, fmt::format("sphere {} has the radius {}; allowed: lengths above 0", id, radius));
  spheres_.push_back({centre, radius, id, line});
}

void PackingBuilder::sort() {
  const auto by_id = [](const Sphere& a, const Sphere& b) { return a.id < b.id; };
  if (!std::is_sorted(spheres_.begin(), spheres_.end(), by_id))
    std::stable_sort(spheres_.begin(), spheres_.end(), by_id);
  const auto twice = std::adjacent_find(spheres_.begin(), spheres_.end(),
                                        [](const Sphere& a, const Sphere& b) { return a.id == b.id; });
  if (twice != spheres_.end())
    fail_in_line(path_, (twice + 1)->line, fmt::format("sphere {} stood already in line {}", twice->id, twice->line));
}

Interval PackingBuilder::extent(std::size_t axis) const {
  Interval all{spheres_.front().centre[axis], spheres_.front().centre[axis]};
  for (const Sphere& s : spheres_) {
    all.low = std::min(all.low, s.centre[axis] - s.radius);
    all.high = std::max(all.high, s.centre[axis] + s.radius);
  }
  return all;
}

void PackingBuilder::check_axis(std::size_t axis, const Interval& edge, Boundary boundary, bool vertical) const {
  const double length = edge.high - edge.low;
  if (!std::isfinite(length) || length <= 0)
    fail_in_line(path_, 0, fmt::format("the box goes from {} = {} to {}", kAxis[axis], edge.low, edge.high));
  const bool floor = boundary == Boundary::wall || (boundary == Boundary::open && vertical);
  for (const Sphere& s : spheres_) {
    const double x = s.centre[axis];
    if ((floor && x < edge.low) || (boundary == Boundary::wall && x > edge.high))
      fail_in_line(path_, s.line,
                   fmt::format("sphere {} at {} = {} lies beyond the wall at {}", s.id, kAxis[axis], x,
                               x < edge.low ? edge.low : edge.high));
    if (boundary == Boundary::periodic && 2 * s.radius > length)
      fail_in_line(path_, s.line,
                   fmt::format("sphere {} of radius {} is wider than the period {} of the {} axis", s.id, s.radius,
                               length, kAxis[axis]));
  }
}

void PackingBuilder::check_extent(const Packing& packing, const std::array<double, 3>& origin) const {
  const auto smallest = std::min_element(spheres_.begin(), spheres_.end(),
                                         [](const Sphere& a, const Sphere& b) { return a.radius < b.radius; });
  for (std::size_t a = 0; a < static_cast<std::size_t>(packing.dimension); ++a) {
    const Interval all = extent(a);
    const double longest = std::max(all.high, origin[a] + packing.size[a]) - std::min(all.low, origin[a]);
    if (!(longest <= kLongestExtent * smallest->radius))
      fail_in_line(path_, smallest->line,
                   fmt::format("sphere {} of radius {} is lost in a packing that extends over {} along {}; "
                               "the most is {:g} radii",
                               smallest->id, smallest->radius, longest, kAxis[a], kLongestExtent));
  }
}

ReadPacking PackingBuilder::finish(const Surroundings& file, const Surroundings& stated) {
  if (spheres_.empty())
    fail_in_line(path_, 0, "there is no sphere in the file");
  sort();
  ReadPacking read;
  read.said = merged(file, stated);
  const bool flat = std::all_of(spheres_.begin(), spheres_.end(), [](const Sphere& s) { return s.centre[2] == 0; });
  Packing& packing = read.packing;
  packing.dimension = read.said.dimension.value_or(flat ? 2 : 3);
  packing.unit = read.said.unit.value_or(LengthUnit::um);
  const auto d = static_cast<std::size_t>(packing.dimension);
  if (d == 2 && !flat)
    fail_in_line(path_, 0, "a packing in 2D, but not all its spheres have z = 0");
  for (std::size_t a = 0; a < d; ++a) {
    const auto& told = read.said.box[a];
    packing.boundary[a] = read.said.boundary[a].value_or(told ? Boundary::wall : Boundary::open);
    if (packing.boundary[a] == Boundary::periodic && !told)
      fail_in_line(path_, 0, fmt::format("the {} axis is periodic, but nothing says its period", kAxis[a]));
    const Interval edge = told ? *told : extent(a);
    check_axis(a, edge, packing.boundary[a], a + 1 == d);
    read.origin[a] = edge.low;
    packing.size[a] = edge.high - edge.low;
  }
  check_extent(packing, read.origin);
  packing.positions.reserve(spheres_.size() * d);
  packing.radii.reserve(spheres_.size());
  read.ids.reserve(spheres_.size());
  for (const Sphere& s : spheres_) {
    for (std::size_t a = 0; a < d; ++a)
      packing.positions.push_back(s.centre[a] - read.origin[a]);
    packing.radii.push_back(s.radius);
    read.ids.push_back(s.id);
  }
  spheres_ = {};
  return read;
}

} // namespace tamp
