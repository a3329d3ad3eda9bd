// tamp status: shows how the campaigns of a store stand.
#include "campaigns/cli/command.h"
#include "campaigns/cli/first_line.h"
#include "campaigns/cli/names.h"
#include "campaigns/cli/open_store.h"
#include "engine/base/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

/// Not-ok jobs that are listed with their reasons; the rest is counted.
constexpr std::size_t kListed = 20;

/// Those of one kind with their reasons.
void print_unsuccessful(const Store& store, const std::vector<Unsuccessful>& jobs, JobKind kind) {
  std::size_t listed = 0;
  std::size_t further = 0;
  for (const Unsuccessful& job : jobs) {
    if (job.kind != kind)
      continue;
    if (++listed > kListed) {
      ++further;
      continue;
    }
    const std::optional<Record> record = store.find(job.key);
    fmt::print("  {}  {}{}: {}: {}\n", short_key(job.key), kind == JobKind::metric ? job.name + " of " : "",
               job_name(job.packing.label, job.packing.point, job.packing.replicate), name_of(job.outcome),
               record ? first_line(record->reason) : "");
  }
  if (further > 0)
    fmt::print("  and {} more {}that are not ok; `tamp results` lists them\n", further,
               kind == JobKind::metric ? "metrics " : "");
}

void print_campaign(const Store& store, const StoredCampaign& campaign) {
  const CampaignExtent extent = store.campaign_extent(campaign.name);
  const std::vector<Unsuccessful> unsuccessful = store.unsuccessful(campaign.name);
  OutcomeCounts counts{};
  for (const Unsuccessful& job : unsuccessful) {
    if (job.kind == JobKind::generation)
      ++counts[static_cast<std::size_t>(job.outcome)];
  }
  counts[static_cast<std::size_t>(Outcome::ok)] = extent.recorded - total(counts);
  fmt::print("{} ({}): {} of {} packings recorded: {}\n", campaign.name, campaign.file, extent.recorded, extent.planned,
             in_words(counts));
  print_unsuccessful(store, unsuccessful, JobKind::generation);
  print_unsuccessful(store, unsuccessful, JobKind::metric);
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
  const std::vector<StoredCampaign> campaigns = store.campaigns();
  for (const StoredCampaign& campaign : campaigns)
    print_campaign(store, campaign);
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
