// Opening, records, campaigns and packings of a store.
#include "store/store.h"

#include "store/campaign_rows.h"
#include "store/file_digest.h"
#include "store/packing_file.h"
#include "store/record_rows.h"
#include "store/store_parts.h"

#include <SQLiteCpp/Transaction.h>
#include <fmt/format.h>

namespace tamp {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw Error(fmt::format("cannot make the folder {}: {}", path.string(), error.message()));
}

std::string_view kind_or_any(std::optional<JobKind> kind) {
  return kind ? name_of(*kind) : "%";
}

} // namespace

bool is_final(Outcome outcome) {
  return outcome != Outcome::failed && outcome != Outcome::crashed && outcome != Outcome::cancelled &&
         outcome != Outcome::lost;
}

Store::Store(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;
Store::~Store() = default;

Store Store::open(const fs::path& folder, Mode mode) {
  if (mode == Mode::create) {
    make_folder(folder / "incoming");
    make_folder(folder / "packings");
  }
  return with_named_file(folder / "tamp.sqlite",
                         [&] { return Store(std::make_unique<Parts>(folder, mode == Mode::create)); });
}

const fs::path& Store::folder() const {
  return parts_->folder;
}
fs::path Store::incoming() const {
  return parts_->folder / "incoming";
}
std::string_view Store::network() const {
  return parts_->network;
}
fs::path Store::jobs_lock() const {
  return parts_->folder / "jobs.lock";
}
fs::path Store::packing_path(std::string_view key) const {
  return parts_->folder / "packings" / key.substr(0, 2) / (std::string(key) + ".h5");
}

fs::path Store::log_path(std::string_view key) const {
  return parts_->folder / "logs" / key.substr(0, 2) / (std::string(key) + ".log");
}

void Store::keep_log(std::string_view key, const fs::path& file) {
  const fs::path kept = log_path(key);
  try {
    if (fs::exists(file) && !fs::is_empty(file)) {
      fs::create_directories(kept.parent_path());
      fs::rename(file, kept);
    } else {
      fs::remove(file);
      fs::remove(kept);
    }
  } catch (const fs::filesystem_error& e) {
    throw Error(e.what());
  }
}

bool Store::put(const Record& record) {
  check_storable(record);
  if (!record.packing_file.empty() && !fs::exists(parts_->folder / record.packing_file))
    throw Error(fmt::format("record {}: its packing {} is not in the store", record.key, record.packing_file));
  return with_statements(*parts_, [&](Statements& statements) {
    SQLite::Transaction transaction(statements.database(), SQLite::TransactionBehavior::IMMEDIATE);
    const bool is_new = insert_record(statements, record);
    parts_->reached(ImportStep::row_written);
    transaction.commit();
    return is_new;
  });
}

bool Store::has(std::string_view key) const {
  return outcome(key).has_value();
}

std::optional<Outcome> Store::outcome(std::string_view key) const {
  return with_statements(*parts_, [&](Statements& statements) { return latest_outcome(statements, key); });
}

std::map<std::string, Outcome> Store::outcomes(std::optional<JobKind> kind) const {
  return with_statements(*parts_, [&](Statements& statements) {
    std::map<std::string, Outcome> found;
    Query row(statements,
              "SELECT key, (SELECT outcome FROM attempts WHERE job = jobs.id ORDER BY attempts.id DESC LIMIT 1) "
              "FROM jobs WHERE kind LIKE ? ORDER BY key",
              kind_or_any(kind));
    while (row.step()) {
      if (const auto known = enum_of<Outcome>(row.text(1)))
        found.emplace_hint(found.end(), row.text(0), *known);
    }
    return found;
  });
}

std::vector<std::string> Store::finished(std::optional<JobKind> kind) const {
  std::vector<std::string> keys;
  for (const auto& [key, how] : outcomes(kind)) {
    if (is_final(how))
      keys.push_back(key);
  }
  return keys;
}

std::optional<Record> Store::find(std::string_view key) const {
  return with_statements(*parts_, [&](Statements& statements) -> std::optional<Record> {
    std::vector<Record> found = select_records(statements, key, true);
    if (found.empty())
      return std::nullopt;
    return std::move(found.front());
  });
}

std::vector<Record> Store::records(std::span<const std::string> keys) const {
  return with_statements(*parts_, [&](Statements& statements) {
    const SQLite::Transaction one_view(statements.database());
    std::vector<Record> found;
    for (const std::string& key : keys) {
      for (Record& record : select_records(statements, key, true))
        found.push_back(std::move(record));
    }
    return found;
  });
}

std::vector<Record> Store::attempts(std::string_view key) const {
  return with_statements(*parts_, [&](Statements& statements) { return select_records(statements, key, false); });
}

std::vector<Record> Store::metric_records(std::string_view packing_key) const {
  const auto keys = with_statements(*parts_, [&](Statements& statements) {
    std::vector<std::string> found;
    Query row(statements, "SELECT key FROM jobs WHERE parent = ? AND kind = 'metric' ORDER BY name, key", packing_key);
    while (row.step())
      found.push_back(row.text(0));
    return found;
  });
  return records(keys);
}

std::vector<RecordedJob> Store::recorded_jobs(JobKind kind, std::string_view name) const {
  return with_statements(*parts_, [&](Statements& statements) {
    std::vector<RecordedJob> jobs;
    Query row(statements, "SELECT key, canonical FROM jobs WHERE kind = ? AND name = ? ORDER BY id", name_of(kind),
              name);
    while (row.step())
      jobs.push_back({row.text(0), row.text(1)});
    return jobs;
  });
}

std::vector<std::string> Store::keys_without_campaign() const {
  return with_statements(*parts_, [&](Statements& statements) {
    std::vector<std::string> keys;
    Query row(statements, "SELECT key FROM jobs WHERE kind = 'generation' AND NOT EXISTS "
                          "(SELECT 1 FROM campaign_jobs WHERE campaign_jobs.key = jobs.key) ORDER BY id");
    while (row.step())
      keys.push_back(row.text(0));
    return keys;
  });
}

Packing Store::read_packing(std::string_view key) const {
  const auto record = find(key);
  if (!record || record->packing_file.empty())
    throw Error(fmt::format("the store {} has no packing of the key {}", parts_->folder.string(), key));
  const fs::path path = parts_->folder / record->packing_file;
  if (file_sha256(path) != record->packing_sha256)
    throw Error(fmt::format("{} is damaged: its SHA-256 is not the one of its record", path.string()));
  return tamp::read_packing(path);
}

void Store::put_campaign(const Plan& plan) {
  with_statements(*parts_, [&](Statements& statements) {
    SQLite::Transaction transaction(statements.database(), SQLite::TransactionBehavior::IMMEDIATE);
    replace_campaign(statements, plan);
    transaction.commit();
  });
}

std::vector<StoredCampaign> Store::campaigns() const {
  return with_statements(*parts_, [](Statements& statements) { return select_campaigns(statements); });
}

std::vector<StoredJob> Store::campaign_jobs(std::string_view campaign) const {
  return with_statements(*parts_, [&](Statements& statements) { return select_campaign_jobs(statements, campaign); });
}

CampaignExtent Store::campaign_extent(std::string_view campaign) const {
  return with_statements(*parts_, [&](Statements& statements) { return select_extent(statements, campaign); });
}

std::vector<Unsuccessful> Store::unsuccessful(std::string_view campaign) const {
  return with_statements(*parts_, [&](Statements& statements) { return select_unsuccessful(statements, campaign); });
}

std::vector<std::string> Store::integrity() const {
  return with_statements(*parts_, [&](Statements& statements) {
    std::vector<std::string> lines;
    Query row(statements, "PRAGMA integrity_check");
    while (row.step())
      lines.push_back(row.text(0));
    if (lines == std::vector<std::string>{"ok"})
      lines.clear();
    return lines;
  });
}

void Store::on_import_step(std::function<void(ImportStep)> hook) {
  parts_->on_step = std::move(hook);
}

} // namespace tamp
