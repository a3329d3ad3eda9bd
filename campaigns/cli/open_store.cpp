// Opens stores and campaign files for the commands.
#include "campaigns/cli/open_store.h"

#include "campaigns/campaign.h"
#include "engine/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <thread>

namespace tamp::cli {

namespace fs = std::filesystem;

bool store_exists(const std::string& folder) {
  return fs::exists(fs::path(folder) / "tamp.sqlite");
}

Store open_for_reading(const std::string& folder) {
  if (!store_exists(folder))
    throw InputError(fmt::format("there is no store in {}: `tamp run` makes one, --store names another", folder));
  return Store::open(folder, Store::Mode::read);
}

std::string whole_key(const Store& store, const std::string& beginning, std::optional<JobKind> kind) {
  std::vector<std::string> found;
  for (const auto& [key, outcome] : store.outcomes(kind)) {
    if (key.starts_with(beginning))
      found.push_back(key);
  }
  if (found.size() != 1)
    throw InputError(fmt::format("{} is no file, and {} keys in {} begin so", beginning,
                                 found.empty() ? "no" : fmt::format("{}", found.size()), store.folder().string()));
  return found.front();
}

FileLock hold(const fs::path& store) {
  const fs::path file = store / "jobs.lock";
  // More than once, as `tamp status` takes the lock for a moment to see whether it is free.
  for (int attempt = 0; attempt < 5; ++attempt) {
    if (std::optional<FileLock> lock = FileLock::try_lock(file))
      return std::move(*lock);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  throw Error(fmt::format("the store {} is in use by {}.\nWait for it to end, or name another store with --store "
                          "(`tamp run` can also --wait for "
                          "it, or --join it).",
                          store.string(), FileLock::holder(file)));
}

namespace {

/// The jobs that ran out of at least as much memory as the plans allow them now.
std::set<std::string> without_more_memory(const Store& store, const std::map<std::string, Outcome>& outcomes,
                                          std::span<const Plan> plans) {
  std::map<std::string, std::int64_t> allowed;
  for (const Plan& plan : plans) {
    for (const PlannedJob& planned : plan.jobs) {
      if (const auto found = outcomes.find(planned.key);
          found != outcomes.end() && found->second == Outcome::memory_limited)
        allowed[planned.key] = std::max(allowed[planned.key], plan.run.memory_mb);
    }
  }
  std::set<std::string> keys;
  for (const auto& [key, memory_mb] : allowed) {
    if (const std::optional<Record> record = store.find(key); record && record->limits.memory_mb >= memory_mb)
      keys.insert(key);
  }
  return keys;
}

} // namespace

Known known_to(const Store& store, Limited limited, std::span<const Plan> plans) {
  std::map<std::string, Outcome> generations = store.outcomes(JobKind::generation);
  std::set<std::string> hopeless =
      limited == Limited::open ? without_more_memory(store, generations, plans) : std::set<std::string>();
  const auto done = [limited, hopeless = std::move(hopeless)](const std::string& key, Outcome outcome) {
    const bool by_limit = outcome == Outcome::time_limited || outcome == Outcome::memory_limited;
    return is_final(outcome) && !(by_limit && limited == Limited::open && !hopeless.contains(key));
  };
  return [&store, done, generations = std::move(generations),
          metrics = store.outcomes(JobKind::metric)](const std::string& key) -> std::optional<Outcome> {
    if (const auto found = generations.find(key); found != generations.end()) {
      const bool lost = leaves_packing(found->second) && !fs::exists(store.packing_path(key));
      return done(key, found->second) && !lost ? std::optional(found->second) : std::nullopt;
    }
    const auto found = metrics.find(key);
    return found != metrics.end() && done(key, found->second) ? std::optional(found->second) : std::nullopt;
  };
}

std::vector<Plan> load_campaigns(const std::vector<std::string>& files) {
  std::vector<Plan> plans;
  std::string mistakes;
  for (const std::string& file : files) {
    try {
      plans.push_back(load_campaign(file));
    } catch (const InputError& e) {
      mistakes += fmt::format("{}{}", mistakes.empty() ? "" : "\n", e.what());
    }
  }
  for (std::size_t a = 0; a < plans.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (plans[a].campaign == plans[b].campaign)
        mistakes += fmt::format("{}{} and {} both name their campaign \"{}\"", mistakes.empty() ? "" : "\n",
                                plans[b].file, plans[a].file, plans[a].campaign);
    }
  }
  if (!mistakes.empty())
    throw InputError(mistakes);
  return plans;
}

} // namespace tamp::cli
