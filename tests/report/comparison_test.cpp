// The t test against published values and closed forms; which runs are compared, and how.
#include "report/comparison.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tamp;
using Catch::Contains;

namespace {

// Student, Biometrika 6, 1 (1908): hours of sleep gained by ten patients with two drugs; R prints the results as its
// example of t.test.
const std::vector<double> kFirst = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const std::vector<double> kSecond = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

ComparedRun run(int replicate, double phi, const std::string& digest, const std::string& scene = "box") {
  return {scene, std::to_string(replicate), "key" + std::to_string(replicate), digest, {{"phi", phi}}};
}

} // namespace

TEST_CASE("Welch's and the paired t test give the published values of Student's sleep data") {
  const auto welch = welch_test(kFirst, kSecond);
  REQUIRE(welch);
  CHECK(welch->difference == Approx(1.58));
  CHECK(welch->t == Approx(1.8608).epsilon(1e-4));
  CHECK(welch->freedom == Approx(17.776).epsilon(1e-4));
  CHECK(welch->p == Approx(0.07939).epsilon(1e-3));
  const auto paired = paired_test(kFirst, kSecond);
  REQUIRE(paired);
  CHECK(paired->t == Approx(4.0621).epsilon(1e-4));
  CHECK(paired->freedom == 9);
  CHECK(paired->p == Approx(0.002833).epsilon(1e-3));
}

TEST_CASE("p of one and two degrees of freedom is the closed form, whatever the unit") {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const std::vector<double> zero = {0, 0, 0};
    const std::vector<double> b = {1 * unit, 2 * unit, 4 * unit};
    const auto three = paired_test(zero, b);
    REQUIRE(three);
    CHECK(three->p == Approx(1 - three->t / std::sqrt(2 + three->t * three->t)));
    const auto two = paired_test(std::span(zero).first(2), std::span(b).first(2));
    REQUIRE(two);
    CHECK(two->p == Approx(1 - 2 / M_PI * std::atan(two->t)));
    CHECK(paired_test(b, zero)->p == Approx(three->p));
    CHECK(welch_test(zero, b)->p == Approx(three->p)); // a side without spread leaves the other's two degrees
  }
}

TEST_CASE("Without replicates or without any spread there is no test") {
  const std::vector<double> one = {0.6};
  const std::vector<double> flat = {0.6, 0.6, 0.6};
  CHECK_FALSE(welch_test(one, kFirst));
  CHECK_FALSE(welch_test(flat, flat));
  CHECK_FALSE(paired_test(one, one));
  CHECK_FALSE(paired_test(flat, std::vector<double>{0.7, 0.7, 0.7}));
}

TEST_CASE("Holm raises each probability by the number of those not smaller, in order and up to 1") {
  const std::vector<double> adjusted = holm_adjusted(std::vector<double>{0.01, 0.04, 0.03, 0.005});
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(adjusted[i] == Approx(expected[i]));
  CHECK(holm_adjusted(std::vector<double>{0.9, 0.8}) == std::vector<double>{1, 1});
}

TEST_CASE("Partners are compared in pairs, others as samples, the same packing not at all") {
  const std::vector<ComparedRun> a = {run(0, 0.60, "x"), run(1, 0.62, "y"), run(2, 0.61, "z")};
  const std::vector<ComparedRun> b = {run(1, 0.632, "q"), run(0, 0.611, "p"), run(2, 0.620, "r")};
  const std::vector<ComparedRun> later = {run(5, 0.63, "p"), run(6, 0.64, "q")};

  const Comparison paired = compare_runs(a, b);
  REQUIRE(paired.quantities.size() == 1);
  CHECK(paired.quantities[0].by == ComparedBy::paired);
  CHECK(paired.quantities[0].difference == Approx(0.011));
  CHECK(paired.quantities[0].p ==
        Approx(paired_test(std::vector{0.60, 0.62, 0.61}, std::vector{0.611, 0.632, 0.620})->p));
  CHECK(paired.quantities[0].p_holm == paired.quantities[0].p);
  CHECK(compare_runs(a, later).quantities.at(0).by == ComparedBy::welch);
  CHECK(compare_runs(a, a).quantities.at(0).by == ComparedBy::same);
  CHECK(std::isnan(compare_runs(a, a).quantities.at(0).p));

  const std::vector<ComparedRun> twice = {run(0, 0.60, "x"), run(0, 0.62, "y"), run(2, 0.61, "z")};
  CHECK(compare_runs(twice, b).quantities.at(0).n_a == 3); // of one packing, and yet both count
  CHECK(compare_runs(twice, twice).quantities.at(0).by == ComparedBy::same);
  const std::vector<ComparedRun> also_twice = {run(0, 0.61, "p"), run(0, 0.63, "q"), run(2, 0.6, "r")};
  CHECK(compare_runs(twice, also_twice).quantities.at(0).by == ComparedBy::welch);

  const std::vector<ComparedRun> lone = {run(0, 0.7, "w"), run(0, 0.7, "w", "other box")};
  const Comparison few = compare_runs(a, lone);
  CHECK(few.quantities.at(0).by == ComparedBy::too_few);
  CHECK(few.only_b == std::vector<std::string>{"other box"});
  CHECK_THAT(comparison_text(few, "a", "b"), Contains("too few") && Contains("only in B: other box"));
  CHECK_THAT(comparison_json(few, "a", "b"), Contains("\"p\":null"));
  CHECK_THAT(comparison_csv(few), Contains("box,phi,3,1,"));
}
