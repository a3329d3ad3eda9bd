// Opens stores and campaign files for the commands.
#include "campaigns/cli/open_store.h"

#include "campaigns/campaign.h"
#include "engine/base/error.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
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

FileLock hold(const Store& store) {
  // More than once, as `tamp status` takes the lock for a moment to see whether it is free.
  for (int attempt = 0; attempt < 5; ++attempt) {
    if (std::optional<FileLock> lock = FileLock::try_lock(store.jobs_lock()))
      return std::move(*lock);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  throw Error(fmt::format("the store {} is in use by {}.\nWait for it to end, or name another store with --store.",
                          store.folder().string(), FileLock::holder(store.jobs_lock())));
}

Known known_to(const Store& store, Limited limited) {
  const auto done = [limited](Outcome outcome) {
    const bool by_limit = outcome == Outcome::time_limited || outcome == Outcome::memory_limited;
    return is_final(outcome) && !(by_limit && limited == Limited::open);
  };
  return [&store, done, generations = store.outcomes(JobKind::generation),
          metrics = store.outcomes(JobKind::metric)](const std::string& key) -> std::optional<Outcome> {
    if (const auto found = generations.find(key); found != generations.end()) {
      const bool lost = leaves_packing(found->second) && !fs::exists(store.packing_path(key));
      return done(found->second) && !lost ? std::optional(found->second) : std::nullopt;
    }
    const auto found = metrics.find(key);
    return found != metrics.end() && done(found->second) ? std::optional(found->second) : std::nullopt;
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
