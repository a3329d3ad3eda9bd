// Means and standard deviations against sums done by hand.
#include "report/statistics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace tamp;

TEST_CASE("Mean and sample standard deviation of numbers done by hand") {
  const std::vector<double> values = {2, 4, 4, 4, 5, 5, 7, 9}; // mean 5, squares of deviations 32
  const Summary summary = summarize(values);
  CHECK(summary.n == 8);
  CHECK(summary.mean == Approx(5.0));
  CHECK(summary.median == Approx(4.5));
  CHECK(summary.sd == Approx(std::sqrt(32.0 / 7.0)));
  CHECK(summary.smallest == 2);
  CHECK(summary.largest == 9);
}

TEST_CASE("One number has no standard deviation, none has no mean") {
  const std::vector<double> one = {3.5};
  CHECK(summarize(one).mean == 3.5);
  CHECK(summarize(one).median == 3.5);
  CHECK(std::isnan(summarize(one).sd));
  const Summary none = summarize({});
  CHECK(none.n == 0);
  CHECK(std::isnan(none.mean));
  CHECK(std::isnan(none.median));
}

TEST_CASE("Equal numbers have exactly their mean and no spread") {
  const std::vector<double> values(7, 0.1);
  CHECK(summarize(values).mean == 0.1);
  CHECK(summarize(values).sd == 0);
}

TEST_CASE("The interval of a median is Student's interval of the logarithms") {
  // Logarithms -1, 0, 1: mean 0, standard deviation 1, and 4.302653 is the quantile 0.975 of two degrees of freedom.
  const std::vector<double> values = {std::exp(-1.0), 1, std::exp(1.0)};
  const auto interval = median_interval(values);
  REQUIRE(interval);
  CHECK(interval->high == Approx(std::exp(4.302653 / std::sqrt(3.0))));
  CHECK(interval->low * interval->high == Approx(1));
  const std::vector<double> scaled = {1000 * values[0], 1000, 1000 * values[2]}; // milliseconds
  CHECK(median_interval(scaled)->high == Approx(1000 * interval->high));
  CHECK_FALSE(median_interval(std::vector<double>{1}));
  CHECK_FALSE(median_interval(std::vector<double>{1, 0}));
  CHECK(median_interval(std::vector<double>{2, 2})->high == Approx(2));
}

TEST_CASE("A large common part does not drown the spread") {
  const std::vector<double> values = {1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16};
  CHECK(summarize(values).mean == Approx(1e9 + 10).epsilon(1e-15));
  CHECK(summarize(values).sd == Approx(std::sqrt(30.0)));
}
