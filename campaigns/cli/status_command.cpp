// tamp status: shows how the campaigns of a store stand.
#include "campaigns/cli/command.h"
#include "campaigns/cli/names.h"
#include "campaigns/cli/open_store.h"
#include "engine/base/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

/// Not-ok jobs that are listed with their reasons; the rest is counted.
constexpr std::size_t kListed = 20;

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

void print_not_ok(const Store& store, const std::vector<StoredJob>& jobs,
                  const std::map<std::string, Outcome>& outcomes) {
  std::size_t listed = 0;
  std::size_t further = 0;
  for (const StoredJob& job : jobs) {
    const auto found = outcomes.find(job.key);
    if (found == outcomes.end() || found->second == Outcome::ok)
      continue;
    if (++listed > kListed) {
      ++further;
      continue;
    }
    const std::optional<Record> record = store.find(job.key);
    fmt::print("  {}  {}: {}: {}\n", short_key(job.key), job_name(job.label, job.point, job.replicate),
               name_of(found->second), record ? first_line(record->reason) : "");
  }
  if (further > 0)
    fmt::print("  and {} more that are not ok; `tamp results` lists them\n", further);
}

/// Metrics that failed on packings of the campaign.
void print_failed_metrics(const Store& store, const std::vector<StoredJob>& jobs) {
  for (const StoredJob& job : jobs) {
    for (const Record& record : store.metric_records(job.key)) {
      if (record.outcome != Outcome::ok)
        fmt::print("  {}  {} of {}: {}: {}\n", short_key(record.key), record.name,
                   job_name(job.label, job.point, job.replicate), name_of(record.outcome), first_line(record.reason));
    }
  }
}

void print_campaign(const Store& store, const StoredCampaign& campaign,
                    const std::map<std::string, Outcome>& outcomes) {
  const std::vector<StoredJob> jobs = store.campaign_jobs(campaign.name);
  OutcomeCounts counts{};
  for (const StoredJob& job : jobs) {
    if (const auto found = outcomes.find(job.key); found != outcomes.end())
      ++counts[static_cast<std::size_t>(found->second)];
  }
  fmt::print("{} ({}): {} of {} packings recorded: {}\n", campaign.name, campaign.file, total(counts), jobs.size(),
             in_words(counts));
  print_not_ok(store, jobs, outcomes);
  print_failed_metrics(store, jobs);
}

/// Whether somebody runs jobs on the store; where the lock cannot be opened (a read-only place) nobody does from here.
bool is_in_use(const Store& store) {
  try {
    return std::filesystem::exists(store.jobs_lock()) && !FileLock::try_lock(store.jobs_lock());
  } catch (const Error&) {
    return false;
  }
}

int status(const std::string& folder) {
  const Store store = open_for_reading(folder);
  const std::map<std::string, Outcome> outcomes = store.outcomes(JobKind::generation);
  const std::vector<StoredCampaign> campaigns = store.campaigns();
  for (const StoredCampaign& campaign : campaigns)
    print_campaign(store, campaign, outcomes);
  if (campaigns.empty())
    fmt::print("no campaign has been run in {}\n", folder);
  if (is_in_use(store))
    fmt::print("in use: {} is running jobs\n", FileLock::holder(store.jobs_lock()));
  return kOk;
}

constexpr const char* kExamples =
    R"(One paragraph per campaign of the store: packings recorded, outcomes, and the reasons of those that are not ok.
Example:
  tamp status --store results)";

} // namespace

void declare_status(CommandLine& line) {
  const auto folder = std::make_shared<std::string>(kDefaultStore);
  CLI::App& app =
      line.add("status", "Show how the campaigns of a store stand", kExamples, [folder] { return status(*folder); });
  add_store_option(app, *folder);
}

} // namespace tamp::cli
