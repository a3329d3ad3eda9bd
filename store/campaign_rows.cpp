// Writes and reads the rows of a campaign.
#include "store/campaign_rows.h"

#include "engine/base/canonical_json.h"
#include "engine/model/parameter.h"

#include <nlohmann/json.hpp>

namespace tamp {
namespace {

/// [a,b,…] of texts that are JSON already.
std::string json_array(const std::vector<std::string>& items) {
  std::string text = "[";
  for (const std::string& item : items)
    text += (text.size() > 1 ? "," : "") + item;
  return text + "]";
}

} // namespace

std::string metric_settings(const Metric& metric) {
  JsonPaths paths;
  collect(metric_parameters(), metric, "", paths);
  return canonical_json(paths);
}

std::string campaign_settings(const Plan& plan) {
  std::vector<std::string> metrics;
  for (const Metric& metric : plan.metrics)
    metrics.push_back(metric_settings(metric));
  std::vector<std::string> tables;
  for (const std::string& table : plan.report.tables)
    tables.push_back(canonical_string(table));
  JsonPaths run;
  collect(run_parameters(), plan.run, "", run);
  return "{\"metrics\":" + json_array(metrics) + ",\"report\":{\"tables\":" + json_array(tables) +
         "},\"run\":" + canonical_json(run) + "}";
}

void replace_campaign(Statements& statements, const Plan& plan) {
  Query(statements, "DELETE FROM campaign_jobs WHERE campaign = (SELECT id FROM campaigns WHERE name = ?)",
        plan.campaign)
      .step();
  Query(statements,
        "INSERT INTO campaigns (name, title, file, settings) VALUES (?, ?, ?, ?) ON CONFLICT (name) DO UPDATE SET "
        "title = excluded.title, file = excluded.file, settings = excluded.settings",
        plan.campaign, plan.title, plan.file, campaign_settings(plan))
      .step();
  std::int64_t position = 0;
  for (const PlannedJob& job : plan.jobs) {
    Query(statements,
          "INSERT INTO campaign_jobs (campaign, position, key, label, replicate, point) "
          "VALUES ((SELECT id FROM campaigns WHERE name = ?), ?, ?, ?, ?, ?)",
          plan.campaign, position++, job.key, job.label, job.job.replicate, nlohmann::json(job.point).dump())
        .step();
  }
}

std::vector<StoredCampaign> select_campaigns(Statements& statements) {
  std::vector<StoredCampaign> campaigns;
  Query row(statements, "SELECT name, title, file, settings FROM campaigns ORDER BY id");
  while (row.step())
    campaigns.push_back({row.text(0), row.text(1), row.text(2), row.text(3)});
  return campaigns;
}

std::vector<StoredJob> select_campaign_jobs(Statements& statements, std::string_view campaign) {
  std::vector<StoredJob> jobs;
  Query row(statements,
            "SELECT campaigns.name, key, label, replicate, point FROM campaigns JOIN campaign_jobs "
            "ON campaign_jobs.campaign = campaigns.id WHERE campaigns.name = ? ORDER BY position",
            campaign);
  while (row.step()) {
    jobs.push_back({row.text(0), row.text(1), row.text(2), row.integer(3),
                    nlohmann::json::parse(row.text(4)).get<std::map<std::string, std::string>>()});
  }
  return jobs;
}

} // namespace tamp
