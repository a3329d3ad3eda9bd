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

std::string point_text(const PlannedJob& job) {
  return nlohmann::json(job.point).dump();
}

StoredJob job_of(const Query& row, int first) {
  return {row.text(first), row.text(first + 1), row.text(first + 2), row.integer(first + 3),
          nlohmann::json::parse(row.text(first + 4)).get<std::map<std::string, std::string>>()};
}

/// Whether the rows say of the campaign what the plan says.
bool holds_campaign(Statements& statements, const Plan& plan) {
  Query campaign(statements, "SELECT title, file, settings FROM campaigns WHERE name = ?", plan.campaign);
  if (!campaign.step() || campaign.text(0) != plan.title || campaign.text(1) != plan.file ||
      campaign.text(2) != campaign_settings(plan))
    return false;
  Query row(statements,
            "SELECT key, label, replicate, point FROM campaign_jobs WHERE campaign = (SELECT id FROM campaigns WHERE "
            "name = ?) ORDER BY position",
            plan.campaign);
  for (const PlannedJob& job : plan.jobs) {
    if (!row.step() || row.text(0) != job.key || row.text(1) != job.label || row.integer(2) != job.job.replicate ||
        row.text(3) != point_text(job))
      return false;
  }
  return !row.step();
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
  if (holds_campaign(statements, plan))
    return;
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
          plan.campaign, position++, job.key, job.label, job.job.replicate, point_text(job))
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
  while (row.step())
    jobs.push_back(job_of(row, 0));
  return jobs;
}

CampaignExtent select_extent(Statements& statements, std::string_view campaign) {
  Query row(statements,
            "SELECT count(*), count(jobs.id) FROM campaign_jobs LEFT JOIN jobs ON jobs.key = campaign_jobs.key "
            "WHERE campaign = (SELECT id FROM campaigns WHERE name = ?)",
            campaign);
  row.step();
  return {static_cast<std::size_t>(row.integer(0)), static_cast<std::size_t>(row.integer(1))};
}

std::vector<Unsuccessful> select_unsuccessful(Statements& statements, std::string_view campaign) {
  // From the few that failed to their campaign: one walk along the index of attempts, however many jobs there are.
  Query row(statements,
            "WITH bad AS MATERIALIZED (SELECT job, max(id), outcome FROM attempts GROUP BY job HAVING outcome != 'ok') "
            "SELECT campaigns.name, c.key, c.label, c.replicate, c.point, j.kind, j.key, j.name, bad.outcome "
            "FROM bad JOIN jobs j ON j.id = bad.job "
            "JOIN campaign_jobs c ON c.key = CASE j.kind WHEN 'generation' THEN j.key ELSE j.parent END "
            "JOIN campaigns ON campaigns.id = c.campaign WHERE campaigns.name = ? ORDER BY c.position, j.id",
            campaign);
  std::vector<Unsuccessful> found;
  while (row.step())
    found.push_back({job_of(row, 0), enum_from_row<JobKind>(row.text(5), "kind"), row.text(6), row.text(7),
                     enum_from_row<Outcome>(row.text(8), "outcome")});
  return found;
}

} // namespace tamp
