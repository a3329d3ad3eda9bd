// Joins the two sides and tests each quantity.
#include "report/comparison.h"

#include "report/statistics.h"

#include <algorithm>
#include <set>

namespace tamp {

namespace {

using Side = std::multimap<std::string, const ComparedRun*>; // by pair

std::map<std::string, Side> by_scene(std::span<const ComparedRun> runs) {
  std::map<std::string, Side> scenes;
  for (const ComparedRun& run : runs)
    scenes[run.scene].emplace(run.pair, &run);
  return scenes;
}

/// Values of the runs that have the quantity, in the order of their pairs.
struct Sample {
  std::vector<const ComparedRun*> runs;
  std::vector<double> values;
};

Sample sample(const Side& side, const std::string& quantity) {
  Sample found;
  for (const auto& [pair, run] : side) {
    if (const auto value = run->measures.find(quantity); value != run->measures.end()) {
      found.runs.push_back(run);
      found.values.push_back(value->second);
    }
  }
  return found;
}

bool all_pairs(const Sample& a, const Sample& b, bool (*hold)(const ComparedRun& a, const ComparedRun& b)) {
  return std::equal(a.runs.begin(), a.runs.end(), b.runs.begin(), b.runs.end(),
                    [&](const ComparedRun* left, const ComparedRun* right) { return hold(*left, *right); });
}

ComparedQuantity compare(const Sample& a, const Sample& b) {
  ComparedQuantity row;
  row.n_a = a.values.size();
  row.n_b = b.values.size();
  row.mean_a = summarize(a.values).mean;
  row.mean_b = summarize(b.values).mean;
  row.difference = row.mean_b - row.mean_a;
  const bool repeated =
      std::adjacent_find(a.runs.begin(), a.runs.end(),
                         [](const ComparedRun* x, const ComparedRun* y) { return x->pair == y->pair; }) != a.runs.end();
  const bool paired =
      !repeated && all_pairs(a, b, [](const ComparedRun& x, const ComparedRun& y) { return x.pair == y.pair; });
  const bool same = all_pairs(a, b, [](const ComparedRun& x, const ComparedRun& y) {
    return x.key == y.key && x.digest == y.digest && !x.digest.empty();
  });
  if (same && a.values == b.values) {
    row.by = ComparedBy::same;
    return row;
  }
  if (const auto test = paired ? paired_test(a.values, b.values) : welch_test(a.values, b.values)) {
    row.by = paired ? ComparedBy::paired : ComparedBy::welch;
    row.p = test->p;
  }
  return row;
}

void adjust(std::vector<ComparedQuantity>& rows) {
  std::vector<ComparedQuantity*> tested;
  std::vector<double> p;
  for (ComparedQuantity& row : rows) {
    if (row.by == ComparedBy::paired || row.by == ComparedBy::welch) {
      tested.push_back(&row);
      p.push_back(row.p);
    }
  }
  const std::vector<double> adjusted = holm_adjusted(p);
  for (std::size_t i = 0; i < tested.size(); ++i)
    tested[i]->p_holm = adjusted[i];
}

} // namespace

Comparison compare_runs(std::span<const ComparedRun> a, std::span<const ComparedRun> b) {
  const auto left = by_scene(a);
  const auto right = by_scene(b);
  Comparison comparison;
  for (const auto& [scene, side] : left) {
    const auto other = right.find(scene);
    if (other == right.end()) {
      comparison.only_a.push_back(scene);
      continue;
    }
    std::set<std::string> quantities;
    for (const auto& [pair, run] : side) {
      for (const auto& [quantity, value] : run->measures)
        quantities.insert(quantity);
    }
    for (const std::string& quantity : quantities) {
      const Sample of_b = sample(other->second, quantity);
      if (of_b.values.empty())
        continue;
      ComparedQuantity row = compare(sample(side, quantity), of_b);
      row.scene = scene;
      row.quantity = quantity;
      comparison.quantities.push_back(row);
    }
  }
  for (const auto& [scene, side] : right) {
    if (!left.contains(scene))
      comparison.only_b.push_back(scene);
  }
  adjust(comparison.quantities);
  return comparison;
}

} // namespace tamp
