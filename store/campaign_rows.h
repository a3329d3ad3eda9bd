// Campaigns as rows of the tables campaigns and campaign_jobs.
#pragma once

#include "store/query.h"
#include "store/store.h"

#include <string>
#include <string_view>
#include <vector>

namespace tamp {

/// The text of a metric's parameters alone, without its revision: {"bins":80,"name":"hellinger"}.
std::string metric_settings(const Metric& metric);

/// What a campaign asks for beside its jobs: {"metrics":[…],"report":{"tables":[…]},"run":{…}}.
std::string campaign_settings(const Plan& plan);

/// Puts the campaign in place of an earlier one of its name, inside the caller's transaction; writes what differs.
void replace_campaign(Statements& statements, const Plan& plan);

std::vector<StoredCampaign> select_campaigns(Statements& statements);
std::vector<StoredJob> select_campaign_jobs(Statements& statements, std::string_view campaign);
CampaignExtent select_extent(Statements& statements, std::string_view campaign);
std::vector<Unsuccessful> select_unsuccessful(Statements& statements, std::string_view campaign);

} // namespace tamp
