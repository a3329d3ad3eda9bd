// Writes comparisons as text, CSV and JSON.
#include "engine/base/canonical_json.h"
#include "report/comparison.h"
#include "report/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp {

namespace {

constexpr std::array<const char*, 4> kBy = {"same bytes", "paired t", "Welch t", "no test"};

const char* name(ComparedBy by) {
  return kBy[static_cast<std::size_t>(by)];
}

std::string short_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("-");
}

std::string json_number(double value) {
  return std::isfinite(value) ? canonical_number(value) : std::string("null");
}

std::string json_list(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words)
    out += (out.empty() ? "" : ",") + canonical_string(word);
  return "[" + out + "]";
}

std::string remarks(const Comparison& comparison) {
  const auto count = [&](auto condition) {
    return std::count_if(comparison.quantities.begin(), comparison.quantities.end(), condition);
  };
  const auto tested = count([](const ComparedQuantity& row) { return std::isfinite(row.p); });
  const auto few = count([](const ComparedQuantity& row) { return row.by == ComparedBy::too_few; });
  std::string out =
      fmt::format("\n{} tests. p: chance of such a difference where there is none, by Student's t over the "
                  "replicates; p_holm: the same for {} questions asked at once.\n",
                  tested, tested);
  if (few > 0)
    out += fmt::format("{} quantities have too few replicates (under 2 a side) or no spread: their difference may mean "
                       "nothing.\n",
                       few);
  for (const std::string& scene : comparison.only_a)
    out += "only in A: " + scene + "\n";
  for (const std::string& scene : comparison.only_b)
    out += "only in B: " + scene + "\n";
  return out;
}

} // namespace

std::string comparison_text(const Comparison& comparison, const std::string& a, const std::string& b) {
  std::string out = fmt::format("A: {}\nB: {}\n", a, b);
  const std::string* scene = nullptr;
  for (const ComparedQuantity& row : comparison.quantities) {
    if (scene == nullptr || *scene != row.scene) {
      out += fmt::format("\n{}\n{:<22} {:>9} {:>12} {:>12} {:>12} {:>11} {:>9} {:>9}\n", row.scene, "quantity", "n",
                         "mean A", "mean B", "B - A", "by", "p", "p_holm");
      scene = &row.scene;
    }
    out += fmt::format("{:<22} {:>9} {:>12.6g} {:>12.6g} {:>12.4g} {:>11} {:>9} {:>9}\n", row.quantity,
                       fmt::format("{} {}", row.n_a, row.n_b), row.mean_a, row.mean_b, row.difference, name(row.by),
                       short_number(row.p), short_number(row.p_holm));
  }
  return out + remarks(comparison);
}

std::string comparison_csv(const Comparison& comparison) {
  std::string out = "scene,quantity,n_a,n_b,mean_a,mean_b,difference,by,p,p_holm\n";
  for (const ComparedQuantity& row : comparison.quantities) {
    out += csv_record(std::array<std::string, 10>{
        row.scene, row.quantity, std::to_string(row.n_a), std::to_string(row.n_b), csv_number(row.mean_a),
        csv_number(row.mean_b), csv_number(row.difference), name(row.by), csv_number(row.p), csv_number(row.p_holm)});
  }
  return out;
}

std::string comparison_json(const Comparison& comparison, const std::string& a, const std::string& b) {
  std::string rows;
  for (const ComparedQuantity& row : comparison.quantities) {
    rows += fmt::format(
        R"({}{{"scene":{},"quantity":{},"n_a":{},"n_b":{},"mean_a":{},"mean_b":{},"difference":{},"by":{},"p":{},"p_holm":{}}})",
        rows.empty() ? "\n" : ",\n", canonical_string(row.scene), canonical_string(row.quantity), row.n_a, row.n_b,
        json_number(row.mean_a), json_number(row.mean_b), json_number(row.difference), canonical_string(name(row.by)),
        json_number(row.p), json_number(row.p_holm));
  }
  return fmt::format("{{\"a\":{},\"b\":{},\"quantities\":[{}],\"only_a\":{},\"only_b\":{}}}\n", canonical_string(a),
                     canonical_string(b), rows, json_list(comparison.only_a), json_list(comparison.only_b));
}

} // namespace tamp
