// Results as other programs read them.
#include "engine/base/error.h"
#include "store/results_export.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/store/examples.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace tamp;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

Metric hellinger(std::int64_t bins) {
  Metric metric;
  metric.name = MetricName::hellinger;
  metric.bins = bins;
  return metric;
}

/// The campaign "c" of three jobs: the first measured, the second failed, the third not yet run.
Store example_store(const ScratchFolder& folder) {
  Store store = Store::open(folder / "s", Store::Mode::create);
  store.put_campaign(example_plan("c", 3));
  store.put(example_record(0));
  Record failed = example_record(1);
  failed.outcome = Outcome::failed;
  failed.reason = "said \"no\",\nthen left";
  failed.measures.clear();
  store.put(failed);
  const std::string key = example_record(0).key;
  store.put(example_metric_record(hellinger(80), key, {{"H_N", 0.125, "1"}, {"bins", 80, "1"}}));
  store.put(example_metric_record(hellinger(40), key, {{"H_N", 0.25, "1"}, {"bins", 40, "1"}}));
  Metric phi;
  Record unmeasurable = example_metric_record(phi, key, {});
  unmeasurable.outcome = Outcome::not_applicable;
  store.put(unmeasurable);
  return store;
}

} // namespace

TEST_CASE("results as JSON have the promised form") {
  const ScratchFolder folder;
  const Store store = example_store(folder);
  const json list = json::parse(results_json(results(store, "c")));
  REQUIRE(list.size() == 2);
  const json& first = list[0];
  std::vector<std::string> keys;
  for (const auto& [key, value] : first.items())
    keys.push_back(key);
  CHECK(keys == std::vector<std::string>{"campaign", "key", "label", "measures", "method", "outcome", "parameters",
                                         "parent", "reason", "replicate", "scene", "time"});
  CHECK(first["key"] == example_record(0).key);
  CHECK(first["campaign"] == "c");
  CHECK(first["method"] == "drop-and-roll");
  CHECK(first["replicate"] == 0);
  CHECK(first["outcome"] == "ok");
  CHECK(first["scene"] == json::parse(example_record(0).canonical)["scene"]);
  CHECK(first["time"] ==
        json{{"wall_s", 1.0 / 3.0}, {"cpu_s", 0.3}, {"peak_rss_bytes", 123456789}, {"mode", "exclusive"}});
  // Only the metric that the campaign asks for.
  CHECK(first["measures"] == json{{"N", {{"value", 20654.0}, {"unit", "1"}}},
                                  {"gap", {{"value", 0.1 + 0.2}, {"unit", "um"}}},
                                  {"tiny", {{"value", 4.9e-324}, {"unit", "1"}}},
                                  {"H_N", {{"value", 0.125}, {"unit", "1"}}},
                                  {"bins", {{"value", 80.0}, {"unit", "1"}}}});
  CHECK(list[1]["outcome"] == "failed");
  CHECK(list[1]["replicate"] == 1);
  CHECK(list[1]["reason"] == "said \"no\",\nthen left");
  CHECK(list[1]["measures"] == json::object());
}

TEST_CASE("two metrics that give one name are told apart by their parameters") {
  const ScratchFolder folder;
  Store store = example_store(folder);
  Plan plan = example_plan("both", 1);
  plan.metrics = {hellinger(80), hellinger(40)};
  store.put_campaign(plan);
  const auto rows = results(store, "both");
  REQUIRE(rows.size() == 1);
  const auto value = [&](const std::string& name) {
    for (const Measure& m : rows[0].measures) {
      if (m.name == name)
        return m.value;
    }
    return -1.0;
  };
  CHECK(value("H_N") == 0.125);
  CHECK(value("H_N{bins=40}") == 0.25);
  CHECK(value("bins{bins=40}") == 40);
}

TEST_CASE("without a campaign all are listed, and jobs of none at the end") {
  const ScratchFolder folder;
  Store store = example_store(folder);
  store.put_campaign(example_plan("d", 1));
  store.put(example_record(7));
  const auto rows = results(store, "");
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].campaign == "c");
  CHECK(rows[1].campaign == "c");
  CHECK(rows[2].campaign == "d");
  CHECK(rows[2].generation.key == rows[0].generation.key);
  CHECK(rows[3].campaign.empty());
  CHECK(rows[3].replicate == 7);
  CHECK(rows[0].label == "D&R");
  CHECK(rows[0].point.at("scene/psd/mu_ln") == "0.5");
  CHECK_THROWS_AS(results(store, "e"), InputError);
  CHECK_THROWS_WITH(results(store, "e"), Contains("\"e\"") && Contains("c, d"));
  CHECK(results_json({}) == "[]\n");
}

TEST_CASE("a record whose canonical text is no JSON is listed all the same") {
  const ScratchFolder folder;
  Store store = Store::open(folder / "s", Store::Mode::create);
  Record odd = example_record(0);
  odd.canonical = "?";
  store.put(odd);
  Record metric = example_metric_record({}, odd.key, {{"phi", 0.5, "1"}});
  metric.canonical = "[]";
  store.put(metric);
  const auto rows = results(store, "");
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].measures.back().name == "phi");
  const json list = json::parse(results_json(rows));
  CHECK(list[0]["scene"] == json::object());
  CHECK_THAT(results_csv(rows), Contains(odd.key));
}

TEST_CASE("results as CSV spread scenes and measures over columns") {
  const ScratchFolder folder;
  const Store store = example_store(folder);
  const std::string csv = results_csv(results(store, "c"));
  const std::string header = csv.substr(0, csv.find("\r\n"));
  CHECK(header == "key,campaign,method,label,parent,replicate,outcome,reason,wall_s,cpu_s,peak_rss_bytes,mode,"
                  "method/lid,method/max_failures,method/on_failure,method/revision,"
                  "scene/count,scene/dimension,scene/psd/law,scene/psd/mu_ln,scene/psd/sigma_ln,scene/sampler,"
                  "scene/sides,scene/size,scene/unit,N,gap [um],tiny,H_N,bins");
  CHECK_THAT(csv, Contains(",\"[600,600]\",um,20654.0,0.30000000000000004,5e-324,0.125,80.0\r\n"));
  CHECK_THAT(csv, Contains(",failed,\"said \"\"no\"\",\nthen left\","));
  CHECK_THAT(csv, Contains("um,,,,,\r\n"));
}
