// Two sides, such as two stores or two methods, set against each other quantity by quantity.
#pragma once

#include "report/t_test.h"

#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace tamp {

/// One run of a side.
struct ComparedRun {
  std::string scene; ///< in words; only runs of one scene are compared
  std::string pair;  ///< what its partner on the other side shares: the packing both come from
  std::string key;
  std::string digest; ///< of its packing
  std::map<std::string, double> measures;
};

/// same: every pair has the same key and packing, and the same value. too_few: fewer than two replicates on a side, or
/// no spread at all: the difference stands, but nothing can be said of its significance.
enum class ComparedBy { same, paired, welch, too_few };

struct ComparedQuantity {
  std::string scene;
  std::string quantity;
  std::size_t n_a = 0;
  std::size_t n_b = 0;
  double mean_a = 0;
  double mean_b = 0;
  double difference = 0; ///< mean b - mean a; with paired, of the pairs, which are all there are
  ComparedBy by = ComparedBy::too_few;
  double p = std::numeric_limits<double>::quiet_NaN();
  double p_holm = std::numeric_limits<double>::quiet_NaN(); ///< among all that were tested
};

struct Comparison {
  std::vector<ComparedQuantity> quantities; ///< that both sides have, by scene and name
  std::vector<std::string> only_a;          ///< scenes
  std::vector<std::string> only_b;
};

/// Pairs are used where every run of either side that has the quantity has its one partner, else Welch's test: runs
/// that share nothing, not even radii, are independent, and a number that two of them bear makes no pair.
Comparison compare_runs(std::span<const ComparedRun> a, std::span<const ComparedRun> b);

std::string comparison_text(const Comparison& comparison, const std::string& a, const std::string& b);
std::string comparison_csv(const Comparison& comparison);
std::string comparison_json(const Comparison& comparison, const std::string& a, const std::string& b);

} // namespace tamp
