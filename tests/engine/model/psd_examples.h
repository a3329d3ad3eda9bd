// One size distribution of every family, in micrometres, for contract tests over all laws.
#pragma once

#include "engine/model/psd.h"

#include <cmath>
#include <string>
#include <vector>

namespace tamp::test {

/// The benchmark powder: radii in micrometres, number-weighted, cut to [0.1, 50].
inline Psd lognormal_psd(double mu_ln = 0.30, double sigma_ln = 0.68, double r_min = 0.1, double r_max = 50) {
  Psd psd;
  psd.law = Law::lognormal;
  psd.mu_ln = mu_ln;
  psd.sigma_ln = sigma_ln;
  psd.r_min = r_min;
  psd.r_max = r_max;
  return psd;
}

inline Psd normal_psd(double mean, double sd, double r_min, double r_max) {
  Psd psd;
  psd.law = Law::normal;
  psd.mean = mean;
  psd.sd = sd;
  psd.r_min = r_min;
  psd.r_max = r_max;
  return psd;
}

inline Psd weibull_psd(double scale, double shape, Weighting weighting, double r_min, double r_max) {
  Psd psd;
  psd.law = Law::weibull;
  psd.scale = scale;
  psd.shape = shape;
  psd.weighting = weighting;
  psd.r_min = r_min;
  psd.r_max = r_max;
  return psd;
}

inline Psd histogram_psd(std::vector<double> edges, std::vector<double> weights, Weighting weighting) {
  Psd psd;
  psd.law = Law::histogram;
  psd.edges = std::move(edges);
  psd.weights = std::move(weights);
  psd.weighting = weighting;
  return psd;
}

inline Psd bimodal_psd(double small_radius, double size_ratio, double large_volume_fraction) {
  Psd psd;
  psd.law = Law::bimodal;
  psd.small_radius = small_radius;
  psd.size_ratio = size_ratio;
  psd.large_volume_fraction = large_volume_fraction;
  return psd;
}

inline Psd monodisperse_psd(double radius) {
  Psd psd;
  psd.law = Law::monodisperse;
  psd.radius = radius;
  return psd;
}

struct ContinuousExample {
  std::string name;
  Psd psd;
};

inline std::vector<ContinuousExample> continuous_examples() {
  const std::vector<double> edges{0.0, 0.5, 1.0, 1.001, 4.0, 20.0, 45.0, 60.0};
  const std::vector<double> weights{0.0, 2.0, 1.0, 0.0, 5.0, 0.01, 0.0};
  return {
      {"powder", lognormal_psd()},
      {"wide lognormal", lognormal_psd(0.0, 1.5, 0.1, 10.0)},
      {"upper tail of a lognormal", lognormal_psd(0.0, 0.5, 4.0, 400.0)},
      {"narrow lognormal", lognormal_psd(0.3, 0.01, 0.1, 50.0)},
      {"normal", normal_psd(10, 3, 1, 20)},
      {"upper tail of a normal", normal_psd(1, 0.5, 3, 30)},
      {"narrow normal in wide bounds", normal_psd(10, 0.1, 0.1, 100)},
      {"number Weibull", weibull_psd(5, 2.5, Weighting::number, 0.1, 30)},
      {"number Weibull of small shape", weibull_psd(1, 0.5, Weighting::number, 0.5, 50)},
      {"number Weibull of tiny shape", weibull_psd(1, 0.02, Weighting::number, 0.01, 100)},
      {"tail of a number Weibull", weibull_psd(1, 3, Weighting::number, 2, 20)},
      {"Rosin-Rammler", weibull_psd(10, 1.5, Weighting::volume, 0.5, 50)},
      {"Rosin-Rammler, shape 3", weibull_psd(10, 3, Weighting::volume, 1, 100)},
      {"steep Rosin-Rammler", weibull_psd(10, 20, Weighting::volume, 5, 500)},
      {"tail of a Rosin-Rammler", weibull_psd(1, 3, Weighting::volume, 2, 20)},
      {"number histogram", histogram_psd(edges, weights, Weighting::number)},
      {"volume histogram", histogram_psd(edges, weights, Weighting::volume)},
  };
}

/// The number density as its definition reads, unnormalised and without truncation: the twin to integrate.
inline double raw_density(const Psd& psd, int dimension, double r) {
  switch (psd.law) {
  case Law::lognormal:
    return std::exp(-std::pow((std::log(r) - psd.mu_ln) / psd.sigma_ln, 2) / 2) / r;
  case Law::normal:
    return std::exp(-std::pow((r - psd.mean) / psd.sd, 2) / 2);
  case Law::weibull: {
    const double density = std::pow(r / psd.scale, psd.shape - 1) * std::exp(-std::pow(r / psd.scale, psd.shape));
    return psd.weighting == Weighting::number ? density : density / std::pow(r, dimension);
  }
  case Law::histogram:
    for (std::size_t i = 0; i < psd.weights.size(); ++i) {
      if (r < psd.edges[i] || r >= psd.edges[i + 1])
        continue;
      const double density = psd.weights[i] / (psd.edges[i + 1] - psd.edges[i]);
      return psd.weighting == Weighting::number ? density : density / std::pow(r, dimension);
    }
    return 0;
  default:
    return unstated;
  }
}

/// The same distribution in a unit of length that is smaller by `factor`.
inline Psd rescaled(Psd psd, double factor) {
  psd.mu_ln += std::log(factor);
  for (double* length : {&psd.radius, &psd.mean, &psd.sd, &psd.small_radius, &psd.scale, &psd.r_min, &psd.r_max}) {
    *length *= factor;
  }
  for (double& edge : psd.edges)
    edge *= factor;
  return psd;
}

} // namespace tamp::test
