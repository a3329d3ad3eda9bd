// Joins generation and metric records into rows.
#include "store/results_export.h"

#include "engine/base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace tamp {
namespace {

using Json = nlohmann::json;

/// The parameters of the metric of a record, without its revision: the form in which a campaign lists its metrics.
Json metric_of(const Record& record) {
  const Json document = Json::parse(record.canonical, nullptr, false);
  Json metric = document.is_object() ? document.value("metric", Json::object()) : Json::object();
  metric.erase("revision");
  return metric;
}

/// "{bins=40,…}": what tells one metric from another of its name.
std::string suffix_of(Json metric) {
  metric.erase("name");
  std::string text;
  for (const auto& [name, value] : metric.items())
    text += (text.empty() ? "{" : ",") + name + "=" + value.dump();
  return text.empty() ? text : text + "}";
}

void add_measures(const Record& record, std::vector<Measure>& measures) {
  const std::string suffix = suffix_of(metric_of(record));
  std::set<std::string> taken;
  for (const Measure& measure : measures)
    taken.insert(measure.name);
  for (Measure measure : record.measures) {
    if (taken.contains(measure.name))
      measure.name += suffix;
    if (!taken.contains(measure.name))
      measures.push_back(std::move(measure));
  }
}

/// The ok records of the metrics of a packing, in the order in which the campaign asks for them.
std::vector<Record> wanted_metrics(const Store& store, const std::string& key, const Json& wanted) {
  std::vector<Record> all = store.metric_records(key);
  std::erase_if(all, [](const Record& r) { return r.outcome != Outcome::ok; });
  if (wanted.is_null())
    return all;
  std::vector<Record> ordered;
  for (const Json& metric : wanted) {
    // A metric of a newer revision has a key of its own; the newest counts.
    const Record* newest = nullptr;
    for (const Record& record : all) {
      if (metric_of(record) == metric && (newest == nullptr || record.revision > newest->revision))
        newest = &record;
    }
    if (newest != nullptr)
      ordered.push_back(*newest);
  }
  return ordered;
}

void add_row(const Store& store, const StoredJob& job, const Json& wanted, std::vector<ResultRow>& rows) {
  auto record = store.find(job.key);
  if (!record)
    return;
  ResultRow row{job.campaign, job.label, job.replicate, job.point, std::move(*record), {}};
  row.measures = row.generation.measures;
  for (const Record& metric : wanted_metrics(store, job.key, wanted))
    add_measures(metric, row.measures);
  rows.push_back(std::move(row));
}

} // namespace

std::vector<ResultRow> results(const Store& store, std::string_view campaign) {
  std::vector<ResultRow> rows;
  bool is_known = campaign.empty();
  std::string known;
  for (const StoredCampaign& stored : store.campaigns()) {
    known += (known.empty() ? "" : ", ") + stored.name;
    if (!campaign.empty() && stored.name != campaign)
      continue;
    is_known = true;
    const Json wanted = Json::parse(stored.settings).at("metrics");
    for (const StoredJob& job : store.campaign_jobs(stored.name))
      add_row(store, job, wanted, rows);
  }
  if (!is_known) {
    throw InputError(fmt::format("the store {} knows no campaign \"{}\"; it knows: {}", store.folder().string(),
                                 campaign, known.empty() ? "none" : known));
  }
  if (campaign.empty()) {
    for (const std::string& key : store.keys_without_campaign()) {
      const auto record = store.find(key);
      const Json document = Json::parse(record->canonical, nullptr, false);
      const std::int64_t replicate = document.is_object() ? document.value("replicate", std::int64_t{0}) : 0;
      add_row(store, {"", key, record->name, replicate, {}}, Json(), rows);
    }
  }
  return rows;
}

} // namespace tamp
