// The contact search over the spheres and walls of a packing.
#pragma once

#include "engine/model/packing.h"
#include "engine/search/contact_search.h"

namespace tamp {

/// The packing must outlive the search. An open vertical axis has its floor but no lid; other open axes have no walls.
template <int D>
ContactSearch<D> search_of(const Packing& packing) {
  SearchBox<D> box;
  for (int axis = 0; axis < D; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const Boundary boundary = packing.boundary[a];
    box.size[axis] = packing.size[a];
    box.periodic[a] = boundary == Boundary::periodic;
    box.wall[a] = {boundary == Boundary::wall || (boundary == Boundary::open && axis == vertical<D>),
                   boundary == Boundary::wall};
  }
  return ContactSearch<D>(box, packing.positions, packing.radii);
}

} // namespace tamp
