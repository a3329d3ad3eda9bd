// Choosing levels and cells, and sorting spheres into them by counting.
#include "engine/search/size_class_grid.h"

#include "engine/base/parallel.h"

namespace tamp {

namespace {

/// A level has at most about this many cells for each of its spheres: few large spheres need no fine grid.
constexpr double kCellsPerSphere = 2;

} // namespace

template <int D>
void SizeClassGrid<D>::build(const Vec<D>& size, const std::array<bool, D>& periodic, std::span<const double> centres,
                             std::span<const double> reaches) {
  const std::size_t n = reaches.size();
  const auto centre = [&](std::uint32_t i) { return Eigen::Map<const Vec<D>>(centres.data() + std::size_t{i} * D); };
  double largest = 0;
  for (const double reach : reaches)
    largest = std::max(largest, reach);

  // Members of each octave of reach, then of the octaves that have any.
  std::vector<std::vector<std::uint32_t>> octaves;
  for (std::size_t i = 0; i < n; ++i) {
    const auto octave = static_cast<std::size_t>(std::ilogb(largest / reaches[i]));
    if (octaves.size() <= octave)
      octaves.resize(octave + 1);
    octaves[octave].push_back(static_cast<std::uint32_t>(i));
  }
  std::erase_if(octaves, [](const auto& members) { return members.empty(); });

  level_of_.resize(n);
  levels_.resize(octaves.size());
  parallel_tasks(octaves.size(), [&](std::size_t l) {
    const std::vector<std::uint32_t>& members = octaves[l];
    Level& level = levels_[l];
    level.periodic = periodic;
    level.largest = 0;
    Vec<D> low = centre(members.front());
    Vec<D> high = low;
    for (const std::uint32_t i : members) {
      level_of_[i] = static_cast<std::uint8_t>(l);
      level.largest = std::max(level.largest, reaches[i]);
      low = low.cwiseMin(centre(i));
      high = high.cwiseMax(centre(i));
    }
    for (int a = 0; a < D; ++a) {
      if (periodic[static_cast<std::size_t>(a)]) {
        low[a] = 0;
        high[a] = size[a];
      }
    }
    const Vec<D> extent = high - low;
    const auto counted = [&](double edge) -> Vec<D> { return (extent / edge).array().floor().max(1.0).matrix(); };
    double edge = 2 * level.largest;
    while (counted(edge).prod() > kCellsPerSphere * static_cast<double>(members.size()) + 1)
      edge *= 1.1;
    const Vec<D> cells = counted(edge);
    level.origin = low;
    for (int a = 0; a < D; ++a) {
      level.cells[static_cast<std::size_t>(a)] = static_cast<std::int64_t>(cells[a]);
      level.edge[a] = extent[a] > 0 ? extent[a] / cells[a] : edge;
      level.inverse_edge[a] = 1 / level.edge[a];
    }

    std::vector<std::uint32_t> cell_of(members.size());
    level.start.assign(static_cast<std::size_t>(cells.prod()) + 1, 0);
    for (std::size_t m = 0; m < members.size(); ++m) {
      const Vec<D> x = (centre(members[m]) - low).cwiseProduct(level.inverse_edge);
      std::int64_t cell = 0;
      for (int a = 0; a < D; ++a) {
        const std::int64_t count = level.cells[static_cast<std::size_t>(a)];
        cell = cell * count + std::clamp(static_cast<std::int64_t>(x[a]), std::int64_t{0}, count - 1);
      }
      cell_of[m] = static_cast<std::uint32_t>(cell);
      ++level.start[static_cast<std::size_t>(cell) + 1];
    }
    for (std::size_t c = 1; c < level.start.size(); ++c)
      level.start[c] += level.start[c - 1];
    // Filling moves each start to the end of its cell; shifting them by one place puts them right again.
    level.entries.resize(members.size());
    for (std::size_t m = 0; m < members.size(); ++m)
      level.entries[level.start[cell_of[m]]++] = {centre(members[m]), reaches[members[m]], members[m]};
    for (std::size_t c = level.start.size() - 1; c > 0; --c)
      level.start[c] = level.start[c - 1];
    level.start[0] = 0;
  });
}

template class SizeClassGrid<2>;
template class SizeClassGrid<3>;

} // namespace tamp
