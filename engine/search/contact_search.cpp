// Levels, cells and the walk over them behind ContactSearch.
#include "engine/search/contact_search.h"

#include "engine/base/parallel.h"

#include <cmath>

namespace tamp {

namespace {

/// Cells are searched this share of the box further than needed, so that rounding hides no pair.
constexpr double kRounding = 1e-12;

/// A level has at most about this many cells for each of its spheres: few large spheres need no fine grid.
constexpr double kCellsPerSphere = 2;

/// Calls f for every D-tuple of integers in [low, high], the last axis running fastest.
template <int D, class F>
void for_each_cell(const std::array<std::int64_t, D>& low, const std::array<std::int64_t, D>& high, F&& f) {
  std::array<std::int64_t, D> cell = low;
  for (std::size_t a = 0; a < D; ++a) {
    if (low[a] > high[a])
      return;
  }
  for (;;) {
    f(cell);
    std::size_t a = D;
    while (a > 0 && cell[a - 1] == high[a - 1]) {
      cell[a - 1] = low[a - 1];
      --a;
    }
    if (a == 0)
      return;
    ++cell[a - 1];
  }
}

std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// Whole number of steps in x, kept in [low, high] before the conversion, which could overflow.
std::int64_t floor_within(double x, double low, double high) {
  return static_cast<std::int64_t>(std::clamp(std::floor(x), low, high));
}

} // namespace

template <int D>
ContactSearch<D>::ContactSearch(const SearchBox<D>& box, std::span<const double> positions,
                                std::span<const double> radii)
    : box_(box), positions_(positions), radii_(radii), count_(radii.size()), entries_(radii.size()) {
  if (count_ == 0)
    return;
  const double largest = *std::max_element(radii.begin(), radii.end());
  const auto level_of = [&](double radius) { return static_cast<std::size_t>(std::ilogb(largest / radius)); };

  std::vector<std::size_t> next; // free place of each level
  for (const double radius : radii) {
    const std::size_t l = level_of(radius);
    if (next.size() <= l)
      next.resize(l + 1, 0);
    ++next[l];
  }
  std::size_t place = 0;
  for (std::size_t& n : next) {
    Level level;
    level.first = place;
    place += n;
    level.last = place;
    n = level.first;
    levels_.push_back(level);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t l = level_of(radii[i]);
    Entry& entry = entries_[next[l]++];
    entry = {Eigen::Map<const Vec<D>>(positions.data() + i * D), radii[i], i, {}};
    for (int a = 0; a < D; ++a) {
      if (box.periodic[static_cast<std::size_t>(a)])
        entry.image[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(std::floor(entry.centre[a] / box.size[a]));
    }
    levels_[l].largest = std::max(levels_[l].largest, radii[i]);
  }
  std::erase_if(levels_, [](const Level& level) { return level.first == level.last; });
  for (Level& level : levels_)
    lay_out(level);
}

template <int D>
Vec<D> ContactSearch<D>::wrapped(const Entry& entry) const {
  Vec<D> x = entry.centre;
  for (int a = 0; a < D; ++a)
    x[a] -= static_cast<double>(entry.image[static_cast<std::size_t>(a)]) * box_.size[a];
  return x;
}

/// Chooses the cells of a level and sorts its entries by them.
template <int D>
void ContactSearch<D>::lay_out(Level& level) {
  const auto size = level.last - level.first;
  Vec<D> low = wrapped(entries_[level.first]);
  Vec<D> high = low;
  for (std::size_t e = level.first; e < level.last; ++e) {
    low = low.cwiseMin(wrapped(entries_[e]));
    high = high.cwiseMax(wrapped(entries_[e]));
  }
  for (int a = 0; a < D; ++a) {
    if (box_.periodic[static_cast<std::size_t>(a)]) {
      low[a] = 0;
      high[a] = box_.size[a];
    }
  }
  level.origin = low;
  const Vec<D> extent = high - low;
  const auto counted = [&](double edge) -> Vec<D> { return (extent / edge).array().floor().max(1.0).matrix(); };
  double edge = 2 * level.largest;
  while (counted(edge).prod() > kCellsPerSphere * static_cast<double>(size) + 1)
    edge *= 1.1;
  const Vec<D> cells = counted(edge);
  for (int a = 0; a < D; ++a) {
    level.cells[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(cells[a]);
    level.edge[a] = extent[a] > 0 ? extent[a] / cells[a] : edge;
  }

  level.start.assign(static_cast<std::size_t>(cells.prod()) + 1, 0);
  for (std::size_t e = level.first; e < level.last; ++e)
    ++level.start[cell_of(level, entries_[e]) + 1];
  level.start[0] = level.first;
  for (std::size_t c = 1; c < level.start.size(); ++c)
    level.start[c] += level.start[c - 1];
  std::vector<std::size_t> next(level.start.begin(), level.start.end() - 1);
  std::vector<Entry> sorted(size);
  for (std::size_t e = level.first; e < level.last; ++e)
    sorted[next[cell_of(level, entries_[e])]++ - level.first] = entries_[e];
  std::copy(sorted.begin(), sorted.end(), entries_.begin() + static_cast<std::ptrdiff_t>(level.first));
}

template <int D>
std::size_t ContactSearch<D>::cell_of(const Level& level, const Entry& entry) const {
  const Vec<D> x = ((wrapped(entry) - level.origin).array() / level.edge.array()).matrix();
  std::int64_t cell = 0;
  for (int a = 0; a < D; ++a) {
    const std::int64_t n = level.cells[static_cast<std::size_t>(a)];
    cell = cell * n + floor_within(x[a], 0, static_cast<double>(n - 1));
  }
  return static_cast<std::size_t>(cell);
}

template <int D>
void ContactSearch<D>::collect(std::size_t first_block, std::size_t blocks, double max_relative_gap,
                               std::vector<std::vector<SpherePair<D>>>& found) const {
  parallel_tasks(blocks, [&](std::size_t b) {
    const std::size_t begin = (first_block + b) * kBlock;
    const std::size_t end = std::min(begin + kBlock, count_);
    for (std::size_t e = begin; e < end; ++e) {
      for (const Level& level : levels_) {
        const bool own = e < level.last;
        search_level(entries_[e], level, own, max_relative_gap, found[b]);
        if (own)
          break;
      }
    }
  });
}

/// Pairs of one sphere with the spheres of one level, all of them at least about as large; on its own level each pair
/// is met from both sides and kept once.
template <int D>
void ContactSearch<D>::search_level(const Entry& from, const Level& level, bool own, double max_relative_gap,
                                    std::vector<SpherePair<D>>& found) const {
  const Vec<D> x = wrapped(from) - level.origin;
  const double reach = from.radius * (1 + max_relative_gap) + level.largest;
  std::array<std::int64_t, D> low;
  std::array<std::int64_t, D> high;
  for (int axis = 0; axis < D; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto n = static_cast<double>(level.cells[a]);
    const double wide = reach + kRounding * (n * level.edge[axis] + std::abs(x[axis]));
    const bool periodic = box_.periodic[a];
    const double most = periodic ? 0x1.0p53 : n - 1;
    low[a] = floor_within((x[axis] - wide) / level.edge[axis], periodic ? -most : 0, most);
    high[a] = floor_within((x[axis] + wide) / level.edge[axis], periodic ? -most : 0, most);
  }
  for_each_cell<D>(low, high, [&](const std::array<std::int64_t, D>& cell) {
    std::int64_t flat = 0;
    std::array<std::int64_t, D> period{};
    for (std::size_t a = 0; a < D; ++a) {
      const std::int64_t n = level.cells[a];
      if (box_.periodic[a])
        period[a] = floor_divide(cell[a], n);
      flat = flat * n + cell[a] - period[a] * n;
    }
    const auto c = static_cast<std::size_t>(flat);
    for (std::size_t e = level.start[c]; e < level.start[c + 1]; ++e) {
      const Entry& to = entries_[e];
      if (own && to.index < from.index)
        continue;
      std::array<std::int64_t, D> shift{};
      Vec<D> across = to.centre - from.centre;
      for (std::size_t a = 0; a < D; ++a) {
        shift[a] = period[a] - to.image[a] + from.image[a];
        across[static_cast<int>(a)] += static_cast<double>(shift[a]) * box_.size[static_cast<int>(a)];
      }
      // Of a sphere and its own images, each pair of opposite images counts once, and the sphere itself not at all.
      if (to.index == from.index && shift <= std::array<std::int64_t, D>{})
        continue;
      const double distance = across.norm();
      const double gap = distance - (from.radius + to.radius);
      if (gap > max_relative_gap * std::min(from.radius, to.radius))
        continue;
      const Vec<D> normal = distance > 0 ? Vec<D>(across / distance) : Vec<D>(Vec<D>::Zero());
      found.push_back({from.index, to.index, normal, gap});
    }
  });
}

template class ContactSearch<2>;
template class ContactSearch<3>;

} // namespace tamp
