// The central part of a packing in which its density is taken.
#pragma once

#include "engine/base/vec.h"
#include "engine/model/packing.h"

namespace tamp {

template <int D>
struct SubBox {
  Vec<D> low;
  Vec<D> high;

  [[nodiscard]] double measure() const { return (high - low).prod(); }
};

/// The box that spans the sphere centres (on periodic axes: the prescribed edge), less a share `inset` of each edge at
/// either end: eqs. (bbox) and (subbox) of the paper. Throws Error where the centres span nothing.
template <int D>
SubBox<D> sub_box(const Packing& packing, double inset);

/// A centre moved by whole periods into the box; other axes stay as they are.
template <int D>
Vec<D> wrapped_centre(const Packing& packing, std::size_t i);

} // namespace tamp
