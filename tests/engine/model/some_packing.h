// Packings for the tests of formats: spheres anywhere within the walls.
#pragma once

#include "engine/base/random.h"
#include "engine/model/packing.h"

#include <catch2/catch.hpp>

namespace tamp::test {

/// Numbers that need all their digits; sides of all kinds.
inline Packing some_packing(int dimension, std::size_t count) {
  Packing packing;
  packing.dimension = dimension;
  packing.size = {1.1, 1.0 / 3.0, dimension == 3 ? 0.7 : 0.0};
  packing.boundary = {Boundary::periodic, Boundary::wall, Boundary::wall};
  packing.boundary[static_cast<std::size_t>(dimension - 1)] = Boundary::open;
  RandomStream random("some packing", 0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
      packing.positions.push_back(packing.size[a] * random.uniform());
    packing.radii.push_back(0.01 + 0.1 * random.uniform());
  }
  return packing;
}

inline void check_same(const Packing& a, const Packing& b) {
  CHECK(a.dimension == b.dimension);
  CHECK(a.unit == b.unit);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(a.dimension); ++axis) {
    CHECK(a.size[axis] == b.size[axis]);
    CHECK(a.boundary[axis] == b.boundary[axis]);
  }
  CHECK((a.positions == b.positions));
  CHECK((a.radii == b.radii));
}

} // namespace tamp::test
