// The bins in which radii are compared with their law.
#pragma once

#include "engine/model/size_law.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace tamp {

/// `bins` equal bins between the smallest and the largest radius of a law; for a discrete law one bin for each size.
class SizeBins {
public:
  /// The law must outlive the bins; bins ≥ 1.
  SizeBins(const SizeLaw& law, std::size_t bins);

  [[nodiscard]] std::size_t count() const { return count_; }
  /// The bin of a radius; nothing if the law has no such size. Radii that miss an end or a discrete size by rounding
  /// alone belong to it.
  [[nodiscard]] std::optional<std::size_t> of(double radius) const;
  /// Share of the sum of r^power that the law puts into each bin; the shares add up to 1.
  [[nodiscard]] std::vector<double> shares(int power) const;
  /// Lower end of a bin, or upper end of the one before; for discrete laws the size itself.
  [[nodiscard]] double edge(std::size_t bin) const;
  [[nodiscard]] bool discrete() const { return !law_->classes().empty(); }

private:
  const SizeLaw* law_;
  std::size_t count_;
};

} // namespace tamp
