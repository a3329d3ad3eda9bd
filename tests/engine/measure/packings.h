// Packings and scenes for the tests of metrics.
#pragma once

#include "engine/base/random.h"
#include "engine/measure/measure.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

namespace tamp::test {

/// The benchmark powder in micrometres: what the scene of a test asks for where nothing else is said.
inline Scene powder_scene(int dimension) {
  Scene scene;
  scene.dimension = dimension;
  scene.psd.law = Law::lognormal;
  scene.psd.mu_ln = 0.30;
  scene.psd.sigma_ln = 0.68;
  scene.psd.r_min = 0.1;
  scene.psd.r_max = 50;
  return scene;
}

/// Spheres of radius 1 and 4; half the volume (2D: area) in the large ones.
inline Scene bimodal_scene(int dimension) {
  Scene scene;
  scene.dimension = dimension;
  scene.psd.law = Law::bimodal;
  scene.psd.small_radius = 1;
  scene.psd.size_ratio = 4;
  scene.psd.large_volume_fraction = 0.5;
  return scene;
}

/// A scene that the metric has something to say about.
inline Scene scene_for(MetricName name, int dimension) {
  const Scene powder = powder_scene(dimension);
  return info(name).applies(powder.psd) ? powder : bimodal_scene(dimension);
}

/// An empty packing in a box of equal edges.
inline Packing box_of(int dimension, double edge, Boundary boundary = Boundary::wall) {
  Packing packing;
  packing.dimension = dimension;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
    packing.size[a] = edge;
    packing.boundary[a] = boundary;
  }
  return packing;
}

inline void add(Packing& packing, std::vector<double> centre, double radius) {
  packing.positions.insert(packing.positions.end(), centre.begin(), centre.end());
  packing.radii.push_back(radius);
}

/// n spheres at independent places (overlapping as they may), radii of three decades up to `largest`.
inline Packing random_packing(int dimension, std::size_t n, double edge, double largest, Boundary boundary,
                              RandomStream& draw) {
  Packing packing = box_of(dimension, edge, boundary);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> centre;
    for (int a = 0; a < dimension; ++a)
      centre.push_back(edge * draw.uniform());
    add(packing, centre, largest * std::pow(10.0, -3 * draw.uniform()));
  }
  return packing;
}

/// Touching spheres on a square or cubic lattice, `edge` of them along each axis; the box fits.
inline Packing cubic_packing(int dimension, int edge, double radius, Boundary boundary) {
  Packing packing = box_of(dimension, 2 * radius * edge, boundary);
  const int layers = dimension == 3 ? edge : 1;
  for (int k = 0; k < layers; ++k) {
    for (int j = 0; j < edge; ++j) {
      for (int i = 0; i < edge; ++i) {
        std::vector<double> centre{(2 * i + 1) * radius, (2 * j + 1) * radius, (2 * k + 1) * radius};
        centre.resize(static_cast<std::size_t>(dimension));
        add(packing, centre, radius);
      }
    }
  }
  return packing;
}

/// The packing and the scene in another unit of length: all numbers times `factor`.
inline Packing rescaled(Packing packing, double factor) {
  for (auto* numbers : {&packing.positions, &packing.radii}) {
    for (double& x : *numbers)
      x *= factor;
  }
  for (double& x : packing.size)
    x *= factor;
  return packing;
}

inline double value_of(const std::vector<Measure>& measures, const std::string& name) {
  for (const Measure& m : measures) {
    if (m.name == name)
      return m.value;
  }
  FAIL("no measure " << name);
  return 0;
}

/// One measure of a packing, with the metric's defaults unless given.
inline double measured(const std::string& name, const Packing& packing, Metric metric, const Scene& scene) {
  return value_of(measure(metric, packing, scene), name);
}

inline Metric metric_of(MetricName name) {
  Metric metric;
  metric.name = name;
  return metric;
}

} // namespace tamp::test
