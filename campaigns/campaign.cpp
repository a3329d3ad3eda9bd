// Reads a campaign file: parse, read, expand, and stop at once with every mistake found.
#include "campaigns/campaign.h"

#include "campaigns/campaign_file.h"
#include "campaigns/expand.h"
#include "campaigns/extend.h"
#include "campaigns/nearest.h"
#include "engine/base/error.h"
#include "engine/base/files.h"

#include <algorithm>
#include <deque>
#include <span>
#include <system_error>

namespace tamp {

namespace {

/// "; nearest: …" if the folder has a JSON file of a similar name.
std::string similar_file(const std::filesystem::path& file) {
  std::vector<std::string> names;
  std::error_code ignored;
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".json" && !std::filesystem::equivalent(entry.path(), file, ignored))
      names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  const std::string found = nearest(file.filename().string(), names);
  return found.empty() ? "" : "\n  nearest: " + (file.parent_path() / found).string();
}

/// Every metric that says something about every scene.
std::vector<Metric> applicable_metrics(std::span<const PlannedJob> jobs) {
  std::vector<Metric> applicable;
  for (const MetricInfo& metric : metrics()) {
    if (std::all_of(jobs.begin(), jobs.end(), [&](const PlannedJob& job) { return metric.applies(job.job.scene.psd); }))
      applicable.push_back({metric.name});
  }
  return applicable;
}

} // namespace

Plan read_campaign(std::string_view text, const std::filesystem::path& file) {
  Mistakes mistakes(file.string(), text);
  std::deque<std::string> extended; // texts that `mistakes` and the document refer to
  const JsonDocument document = read_extended(text, file, extended, mistakes);
  CampaignFile read = read_campaign_file(document, mistakes);
  Plan plan{read.campaign, read.title, file.string(), read.run, read.report, {}, expand(read, mistakes)};
  mistakes.throw_if_any();
  plan.metrics = read.metrics ? *read.metrics : applicable_metrics(plan.jobs);
  return plan;
}

Plan load_campaign(const std::filesystem::path& file) {
  std::string text;
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(file.string() + ": this is a folder; allowed: a campaign file");
  if (!std::filesystem::exists(file, ignored))
    throw InputError(file.string() + ": there is no such file" + similar_file(file));
  try {
    text = read_file(file);
  } catch (const Error& error) {
    throw InputError(error.what());
  }
  return read_campaign(text, file);
}

} // namespace tamp
