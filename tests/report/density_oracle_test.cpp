// The distance of a packing fraction to random close packing: value, flag, and nothing in 2D.
#include "report/density_oracle.h"
#include "tests/report/synthetic_campaign.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace tamp;
using namespace tamp::test;

namespace {

/// Replicates of the scene with these exact packing fractions.
RunGroup group_of(const Scene& scene, const std::vector<double>& phis) {
  SyntheticCampaign campaign;
  for (std::size_t i = 0; i < phis.size(); ++i)
    campaign.add_ok(scene, static_cast<std::int64_t>(i), phis[i] - 0.01, 1); // its phi is phi_paper + 0.01
  const auto find = [&](const std::string& key) {
    const auto found = campaign.records.find(key);
    return found == campaign.records.end() ? std::nullopt : std::optional(found->second);
  };
  return group_runs(collect_runs(campaign.plan, find)).at(0);
}

} // namespace

TEST_CASE("The lognormal powder's packings are measured against Farr and Groot's 0.742") {
  DensityOracle oracle;
  const auto [close, distance] = oracle_cells(group_of(paper_scene(3), {0.72, 0.73}), oracle);
  CHECK(close.value == Approx(0.742).margin(0.001));
  CHECK(distance.value == Approx(0.725 - close.value));
  CHECK(distance.n == 2);
  CHECK_FALSE(distance.doubtful);
}

TEST_CASE("A density above the oracle by more than its deviation is doubtful") {
  DensityOracle oracle;
  CHECK(oracle_cells(group_of(paper_scene(3), {0.78, 0.782}), oracle)[1].doubtful);
  CHECK_FALSE(oracle_cells(group_of(paper_scene(3), {0.70, 0.80}), oracle)[1].doubtful);
  CHECK(oracle_cells(group_of(paper_scene(3), {0.75}), oracle)[1].doubtful);
}

TEST_CASE("Discs have no oracle") {
  DensityOracle oracle;
  const auto cells = oracle_cells(group_of(paper_scene(2), {0.82}), oracle);
  CHECK(cells[0].empty());
  CHECK(cells[1].empty());
}

TEST_CASE("What is denser than random close packing is told with the descriptor that shows why") {
  RunGroup dense = group_of(paper_scene(3), {0.78, 0.782});
  CHECK(above_in_words({&dense, 1}).find("do not explain") != std::string::npos);
  for (Run& run : dense.runs)
    run.generation->measures.push_back({"crystalline", 0.4, "1"});
  CHECK(above_in_words({&dense, 1}).find("40 % of the particles are in crystals") != std::string::npos);
  for (Run& run : dense.runs)
    run.generation->measures.insert(run.generation->measures.begin(), {"overlap_max", 0.05, "1"});
  CHECK(above_in_words({&dense, 1}).find("overlap by up to 0.05") != std::string::npos);
  const RunGroup loose = group_of(paper_scene(3), {0.70, 0.702});
  CHECK(above_in_words({&loose, 1}).empty());
}
