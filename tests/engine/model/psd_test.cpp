// Statements of size distributions: identities, contradictions, impossible values.
#include "engine/base/error.h"
#include "engine/model/psd.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace tamp;
using namespace tamp::test;

namespace {

bool complains(const Psd& psd, const std::string& field) {
  for (const PsdProblem& problem : check(psd)) {
    if (problem.field == field && !problem.problem.empty())
      return true;
  }
  return false;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Psd with_moments(Psd psd, double mean, double sd) {
  psd.mean = mean;
  psd.sd = sd;
  return psd;
}

} // namespace

TEST_CASE("the powder's parameters give its moments") {
  const Moments moments = lognormal_moments(0.30, 0.68);
  CHECK(moments.mean == Approx(1.70).margin(0.005));
  CHECK(moments.sd == Approx(1.30).margin(0.005));
}

TEST_CASE("moments rounded in print do not contradict") {
  CHECK_FALSE(contradiction(with_moments(lognormal_psd(), 1.70, 1.30)));
  CHECK_FALSE(contradiction(with_moments(lognormal_psd(), 1.70, unstated)));
  CHECK_FALSE(contradiction(lognormal_psd()));
  CHECK_FALSE(contradiction(normal_psd(1, 2, 1, 3)));
}

TEST_CASE("the printed order of the powder's numbers contradicts itself, and the message says which order holds") {
  const auto message = contradiction(with_moments(lognormal_psd(0.30, 1.70), 1.30, 0.68));
  REQUIRE(message);
  CAPTURE(*message);
  CHECK(contains(*message, "mu_ln 0.3 and sigma_ln 0.68 go with mean 1.7 and sd 1.3"));
  CHECK(contains(*message, "mu_ln 0.3 and sigma_ln 1.7 go with mean 5.726"));
  CHECK(contains(*message, "mean 1.3 and sd 0.68 go with mu_ln 0.1414 and sigma_ln 0.4918"));
}

TEST_CASE("a contradiction that no order heals offers no order") {
  const auto message = contradiction(with_moments(lognormal_psd(), 3.0, 1.0));
  REQUIRE(message);
  CAPTURE(*message);
  CHECK_FALSE(contains(*message, "order"));
  CHECK(contains(*message, "mean 3 and sd 1 go with mu_ln 1.046 and sigma_ln 0.3246"));
}

TEST_CASE("one moment beyond the tolerance is enough") {
  const Moments moments = lognormal_moments(0.30, 0.68);
  CHECK_FALSE(contradiction(with_moments(lognormal_psd(), moments.mean * 1.009, moments.sd * 0.991)));
  CHECK(contradiction(with_moments(lognormal_psd(), moments.mean * 1.011, moments.sd)));
  CHECK(contradiction(with_moments(lognormal_psd(), unstated, moments.sd * 0.989)));
}

TEST_CASE("a lognormal law has one canonical form") {
  const Moments moments = lognormal_moments(0.30, 0.68);
  Psd by_moments = with_moments(lognormal_psd(unstated, unstated), moments.mean, moments.sd);
  CHECK(check(by_moments).empty());
  const Psd filled = completed(by_moments);
  CHECK(filled.mu_ln == Approx(0.30).epsilon(1e-13));
  CHECK(filled.sigma_ln == Approx(0.68).epsilon(1e-13));
  CHECK_FALSE(stated(filled.mean));
  CHECK_FALSE(stated(filled.sd));

  const Psd both = completed(with_moments(lognormal_psd(), 1.70, 1.30));
  CHECK(both.mu_ln == 0.30);
  CHECK(both.sigma_ln == 0.68);
  CHECK_FALSE(stated(both.mean));
  CHECK_FALSE(stated(both.sd));
  CHECK(completed(normal_psd(10, 3, 1, 20)).mean == 10);
  CHECK_THROWS_AS(completed(with_moments(lognormal_psd(0.30, 1.70), 1.30, 0.68)), InputError);
}

TEST_CASE("every example is a possible law") {
  for (const auto& [name, psd] : continuous_examples()) {
    CAPTURE(name);
    CHECK(check(psd).empty());
  }
  CHECK(check(monodisperse_psd(1)).empty());
  for (const double fraction : {0.0, 0.5, 1.0})
    CHECK(check(bimodal_psd(1, 10, fraction)).empty());
}

TEST_CASE("each parameter of each law is missed, and refused when it is not finite or out of range") {
  struct Row {
    Psd psd;
    std::string field;
    double Psd::*value;
    std::vector<double> wrong;
  };
  const Psd normal = normal_psd(10, 3, 1, 20);
  const Psd weibull = weibull_psd(5, 2, Weighting::number, 0.1, 30);
  const Psd bimodal = bimodal_psd(1, 10, 0.7);
  const std::vector<Row> rows{
      {monodisperse_psd(1), "radius", &Psd::radius, {0, -1}},
      {lognormal_psd(), "mu_ln", &Psd::mu_ln, {}},
      {lognormal_psd(), "sigma_ln", &Psd::sigma_ln, {0, -0.68}},
      {lognormal_psd(), "r_min", &Psd::r_min, {0, -1, 50, 60}},
      {lognormal_psd(), "r_max", &Psd::r_max, {0, -1}},
      {normal, "mean", &Psd::mean, {0, -10}},
      {normal, "sd", &Psd::sd, {0, -3}},
      {normal, "r_min", &Psd::r_min, {0, -1, 20, 30}},
      {normal, "r_max", &Psd::r_max, {0, -1}},
      {weibull, "scale", &Psd::scale, {0, -5}},
      {weibull, "shape", &Psd::shape, {0, -2}},
      {weibull, "r_min", &Psd::r_min, {0, -1, 30, 40}},
      {weibull, "r_max", &Psd::r_max, {0, -1}},
      {bimodal, "small_radius", &Psd::small_radius, {0, -1}},
      {bimodal, "size_ratio", &Psd::size_ratio, {0, 0.99, -2}},
      {bimodal, "large_volume_fraction", &Psd::large_volume_fraction, {-0.01, 1.01}},
  };
  for (Row row : rows) {
    CAPTURE(row.field);
    CHECK(check(row.psd).empty());
    row.wrong.push_back(unstated);
    row.wrong.push_back(std::numeric_limits<double>::infinity());
    for (const double value : row.wrong) {
      CAPTURE(value);
      row.psd.*row.value = value;
      CHECK(complains(row.psd, row.field));
    }
  }
}

TEST_CASE("a value that the law does not read is refused") {
  Psd psd = monodisperse_psd(1);
  psd.mu_ln = 0.3;
  CHECK(complains(psd, "mu_ln"));
  psd = bimodal_psd(1, 2, 0.5);
  psd.r_min = 0.1;
  psd.weighting = Weighting::volume;
  psd.edges = {1, 2};
  psd.weights = {1};
  for (const std::string field : {"r_min", "weighting", "edges", "weights"})
    CHECK(complains(psd, field));
}

TEST_CASE("half a pair of lognormal parameters is not enough") {
  CHECK(complains(lognormal_psd(0.3, unstated), "sigma_ln"));
  CHECK(complains(lognormal_psd(unstated, 0.68), "mu_ln"));
  CHECK(complains(with_moments(lognormal_psd(unstated, unstated), 1.7, unstated), "mu_ln"));
  CHECK(complains(with_moments(lognormal_psd(unstated, 0.68), 1.7, 1.3), "mu_ln"));
}

TEST_CASE("a truncation that leaves nothing of the law is taken for a slip of unit") {
  CHECK(complains(lognormal_psd(0.3, 0.68, 0.1e-6, 50e-6), "r_min"));
  CHECK(complains(lognormal_psd(0.3, 0.68, 1e3, 1e4), "r_min"));
  CHECK(complains(with_moments(lognormal_psd(unstated, unstated, 100, 5000), 1.7, 1.3), "r_min"));
  CHECK(complains(normal_psd(10, 1, 100, 200), "r_min"));
  CHECK(complains(weibull_psd(10, 3, Weighting::volume, 100, 200), "r_min"));
  CHECK(complains(weibull_psd(10, 5, Weighting::number, 0.01, 0.02), "r_min"));
}

TEST_CASE("impossible histograms are refused") {
  const auto field_of = [](std::vector<double> edges, std::vector<double> weights, const std::string& field) {
    return complains(histogram_psd(std::move(edges), std::move(weights), Weighting::number), field);
  };
  CHECK(field_of({}, {}, "weights"));
  CHECK(field_of({1, 2}, {1, 1}, "edges"));
  CHECK(field_of({1, 1, 2}, {1, 1}, "edges"));
  CHECK(field_of({2, 1}, {1}, "edges"));
  CHECK(field_of({0, 1}, {1}, "edges"));
  CHECK(field_of({-1, 1, 2}, {1, 0}, "edges"));
  CHECK(field_of({1, unstated}, {1}, "edges"));
  CHECK(field_of({1, 2, 3}, {1, -1}, "weights"));
  CHECK(field_of({1, 2, 3}, {0, 0}, "weights"));
  CHECK(field_of({1, 2}, {std::numeric_limits<double>::infinity()}, "weights"));
}

TEST_CASE("the number share of large spheres follows from their volume") {
  const Psd psd = bimodal_psd(1, 10, 0.75);
  for (const int dimension : {2, 3}) {
    const double share = large_number_share(psd, dimension);
    const double large = share * std::pow(10, dimension);
    CHECK(large / (large + (1 - share)) == Approx(0.75).epsilon(1e-14));
  }
  CHECK(large_number_share(bimodal_psd(1, 10, 0), 3) == 0);
  CHECK(large_number_share(bimodal_psd(1, 10, 1), 3) == 1);
}

TEST_CASE("names of laws, weightings and samplers") {
  CHECK(name_of(Law::monodisperse) == "monodisperse");
  CHECK(name_of(Law::lognormal) == "lognormal");
  CHECK(name_of(Law::bimodal) == "bimodal");
  CHECK(name_of(Law::normal) == "normal");
  CHECK(name_of(Law::weibull) == "weibull");
  CHECK(name_of(Law::histogram) == "histogram");
  CHECK(name_of(Weighting::number) == "number");
  CHECK(name_of(Weighting::volume) == "volume");
  CHECK(name_of(Sampler::random) == "random");
  CHECK(name_of(Sampler::stratified) == "stratified");
}
