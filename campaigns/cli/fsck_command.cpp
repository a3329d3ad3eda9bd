// tamp fsck: looks a store over and moves aside what is damaged.
#include "campaigns/cli/command.h"
#include "campaigns/cli/open_store.h"
#include "campaigns/cli/shared_run.h"
#include "engine/base/error.h"
#include "store/store_check.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tamp::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string store = kDefaultStore;
  bool dry_run = false;
};

void print(const std::vector<fs::path>& files, const char* what) {
  for (const fs::path& file : files)
    fmt::print("{}: {}\n", what, file.string());
}

/// The database's own faults; with a database that cannot even be opened, the words that say so.
std::vector<std::string> database_faults(const std::string& folder, Store::Mode mode) {
  try {
    return Store::open(folder, mode).integrity();
  } catch (const DamagedStore& e) {
    return {e.what()};
  }
}

int check(const Options& options) {
  if (!store_exists(options.store))
    throw InputError(
        fmt::format("there is no store in {}: `tamp run` makes one, --store names another", options.store));
  std::optional<Seat> seat; // or a result on its way in would look unrecorded
  if (!options.dry_run)
    seat = hold_alone(options.store);
  // Whoever only looks must not need to write: the store may be on a read-only disk.
  const Store::Mode mode = options.dry_run ? Store::Mode::read : Store::Mode::create;
  const std::vector<std::string> faults = database_faults(options.store, mode);
  for (const std::string& line : faults)
    fmt::print("database: {}\n", line);
  if (!faults.empty() && options.dry_run) {
    fmt::print("the database is damaged: without --dry-run, a new one is made of what can be read of it\n");
    return kNotAllOk;
  }
  if (!faults.empty())
    fmt::print("database: {} records read from the damaged one, which has been moved to {}\n",
               salvage_database(options.store), quarantine_folder(options.store).string());

  const Store store = Store::open(options.store, mode);
  const StoreFindings findings = check_store(store);
  print(findings.damaged, "damaged");
  print(findings.unrecorded, "not of any record");
  for (const std::string& key : findings.missing)
    fmt::print("missing: the packing of {}\n", key);
  fmt::print("packings: {} intact, {} damaged, {} missing, {} not of any record\n", findings.intact,
             findings.damaged.size(), findings.missing.size(), findings.unrecorded.size());
  const std::size_t movable = findings.damaged.size() + findings.unrecorded.size();
  if (!options.dry_run && movable > 0) {
    quarantine(store, findings);
    fmt::print("moved to {}: {}; `tamp run` makes what is needed again\n", quarantine_folder(options.store).string(),
               movable);
  }
  return findings.sound() && faults.empty() ? kOk : kNotAllOk;
}

constexpr const char* kExamples =
    R"(Checks the database and compares every packing with the SHA-256 of its record. Damaged files and files that no record
names are moved to STORE/quarantine; nothing is deleted, and what is intact stays in use.
Of a damaged database everything that can still be read goes into a new one. Exit code 1 if anything was found.
Examples:
  tamp fsck --store results
  tamp fsck --store results --dry-run)";

} // namespace

void declare_fsck(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("fsck", "Check a store and move aside what is damaged", kExamples,
                           [options] { return check(*options); });
  app.add_flag("--dry-run", options->dry_run, "Only look; works on a read-only store");
  add_store_option(app, options->store);
}

} // namespace tamp::cli
